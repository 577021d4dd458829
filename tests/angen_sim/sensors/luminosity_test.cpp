#include <gtest/gtest.h>

#include <cmath>

#include "bench.h"
#include "light/lighting.h"

namespace angen {
namespace {

using test::at;
using test::Bench;
using test::box;
using test::plugin_element;

const char* const kLuminosity = "libluminosity_sensor_controller.so";

/// A bench whose light is a number that the test sets.
struct Lit : Bench {
  explicit Lit(const Element& plugin = test::element("plugin")) : Bench(kLuminosity, plugin) {
    world.light_at = [this](light::Probe&, const Pose&) {
      return light::Sample{lux, {0.5F, 0.25F, 0.125F}};
    };
  }
  double lux = 0.0;
};

TEST(Luminosity, ReadsLuxAndColour) {
  Lit bench;
  bench.lux = 120.0;
  const Reading reading = bench.sample();
  EXPECT_EQ(reading.get<double>("illuminance"), 120.0);
  EXPECT_EQ(reading.get<double>("r"), 0.5);
  EXPECT_EQ(reading.get<double>("g"), 0.25);
  EXPECT_EQ(reading.get<double>("b"), 0.125);
  EXPECT_EQ(bench.kind().rate(), 1.0);
}

TEST(Luminosity, NoiseIsRelative) {
  Lit bench(plugin_element({{"noise_stddev", "0.05"}}));
  bench.lux = 200.0;
  double sum = 0.0;
  double squares = 0.0;
  const int n = 20'000;
  for (int i = 0; i < n; ++i) {
    const double lux = bench.sample().get<double>("illuminance");
    sum += lux;
    squares += (lux - 200.0) * (lux - 200.0);
  }
  EXPECT_NEAR(sum / n, 200.0, 0.3);  // 10 / sqrt(n) = 0.07
  EXPECT_NEAR(std::sqrt(squares / n), 10.0, 0.3);
}

TEST(Luminosity, NoiseMakesNoNegativeLight) {
  Lit bench(plugin_element({{"noise_stddev", "2"}}));
  bench.lux = 10.0;
  bool dark = false;
  for (int i = 0; i < 200; ++i) {
    const double lux = bench.sample().get<double>("illuminance", -1.0);
    ASSERT_GE(lux, 0.0);
    dark = dark || lux == 0.0;
  }
  EXPECT_TRUE(dark);
}

TEST(Luminosity, TellsAChangeOfFifteenPercent) {
  Lit bench(plugin_element({{"noise_stddev", "0.3"}}));
  bench.lux = 100.0;
  EXPECT_EQ(bench.sample().event, "");
  bench.lux = 114.0;
  EXPECT_EQ(bench.sample().event, "");
  bench.lux = 116.0;
  const Reading changed = bench.sample();
  EXPECT_EQ(changed.event, "changed");
  EXPECT_EQ(changed.event_detail, "from 100 to 116 lx");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(bench.sample().event, "");  // noise is no change
  bench.lux = 0.0;
  EXPECT_EQ(bench.sample().event, "changed");
  bench.lux = 0.009;
  EXPECT_EQ(bench.sample().event, "");
  bench.lux = 5.0;
  EXPECT_EQ(bench.sample().event, "changed");
}

/// A lamp of 800 lm 2 m ahead of the sensor, in the bench's own scene.
struct Lamp : Bench {
  Lamp() : Bench(kLuminosity), lighting(scene) {
    light::Lamp lamp;
    lamp.pose = at(2.0);
    lamp.luminous_flux = 800.0;
    lighting.add(lamp, 1.0);
    world.light_at = [this](light::Probe& probe, const Pose& pose) {
      return lighting.measure(probe, pose);
    };
  }
  light::Lighting lighting;
};

TEST(Luminosity, FollowsTheInverseSquareLawAndTheCosine) {
  Lamp bench;
  const double ahead = 800.0 / (4.0 * M_PI) / 4.0;
  EXPECT_NEAR(bench.sample().get<double>("illuminance"), ahead, 0.01 * ahead);
  bench.world.at.rotation = from_rpy(0.0, 0.0, M_PI / 3.0);
  EXPECT_NEAR(bench.sample().get<double>("illuminance"), 0.5 * ahead, 0.01 * ahead);
}

TEST(Luminosity, AScreenDarkensIt) {
  Lamp bench;
  const double before = bench.sample().get<double>("illuminance");
  bench.add(box(0.01, 2.0, 2.0), at(1.0));
  EXPECT_LT(bench.sample().get<double>("illuminance"), 0.05 * before);
}

}  // namespace
}  // namespace angen
