#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "bench.h"

namespace angen {
namespace {

using test::at;
using test::Bench;
using test::box;
using test::plugin_element;
using Parameters = std::vector<std::pair<std::string, std::string>>;

const char* const kPir = "libpir_controller.so";
constexpr Nanoseconds kSample = kSecond / 100;
constexpr double kOpening = 1e-5;  // m^2, facet_area times transmission

/// A pyroelectric PIR that is warm and makes no noise, but for what `more` says.
Element pyroelectric(const Parameters& more) {
  Parameters all = {{"model", "pyroelectric"}, {"facet_area", "2e-5"}, {"transmission", "0.5"}};
  const auto has = [&](const std::string& key) {
    for (const auto& pair : more) {
      if (pair.first == key) return true;
    }
    return false;
  };
  if (!has("noise_stddev")) all.emplace_back("noise_stddev", "0");
  if (!has("warm_up")) all.emplace_back("warm_up", "0");
  all.insert(all.end(), more.begin(), more.end());
  return plugin_element(all);
}

/// One pair of zones, 0.4 rad wide each, in the middle of 0.8 rad: positive to the right.
const std::pair<std::string, std::string> kWidePair{"zone_row", "1 -0.8 0.8 -0.5 0.5"};

Shape sphere(double radius) {
  Shape shape;
  shape.type = Shape::Type::kSphere;
  shape.radius = radius;
  return shape;
}

Shape person() {
  Shape shape;
  shape.type = Shape::Type::kCapsule;
  shape.radius = 0.25;
  shape.length = 1.25;
  return shape;
}

rays::ShapeId add_warm(Bench& bench, const Shape& shape, const Pose& pose, double temperature) {
  const rays::ShapeId id = bench.add(shape, pose);
  bench.scene.warm(id, temperature);
  return id;
}

double contrast(double temperature, double air) {
  return 5.670374419e-8 / M_PI * (std::pow(temperature, 4) - std::pow(air, 4));
}

TEST(Pyroelectric, TheFluxOfASphereIsItsRadianceTimesItsSolidAngle) {
  Bench bench(kPir, pyroelectric({kWidePair}));
  const double yaw = -0.4;  // the middle of the positive zone
  const double sine = 0.1 / 3.0;
  add_warm(bench, sphere(0.1), at(3.0 * std::cos(yaw), 3.0 * std::sin(yaw)), 310.0);
  const double expected = kOpening * contrast(310.0, 295.15) * M_PI * sine * sine;
  EXPECT_NEAR(bench.sample(kSample).get<double>("flux"), expected, 0.03 * expected);
}

TEST(Pyroelectric, TheElementsAreSubtracted) {
  Bench bench(kPir, pyroelectric({kWidePair}));
  const auto id = add_warm(bench, sphere(0.1), at(3, -1), 310.0);
  const double right = bench.sample(kSample).get<double>("flux");
  EXPECT_GT(right, 0.0);
  bench.scene.move(id, at(3, 1));
  EXPECT_NEAR(bench.sample(kSample).get<double>("flux"), -right, 0.02 * right);
  bench.scene.move(id, at(3, 0));  // the gap between the two
  EXPECT_NEAR(bench.sample(kSample).get<double>("flux"), 0.0, 0.02 * right);
}

TEST(Pyroelectric, WallsAndFurnitureHideWhatIsWarm) {
  Bench bench(kPir, pyroelectric({kWidePair}));
  add_warm(bench, sphere(0.1), at(3, -1), 310.0);
  const double whole = bench.sample(kSample).get<double>("flux");
  const auto shelf = bench.add(box(0.1, 4, 1), at(2, 0, -0.5));
  EXPECT_NEAR(bench.sample(kSample).get<double>("flux"), 0.5 * whole, 0.07 * whole);
  bench.scene.move(shelf, at(2, 0, 0));
  EXPECT_EQ(bench.sample(kSample).get<double>("flux", -1.0), 0.0);
}

TEST(Pyroelectric, WhatIsColderThanTheAirCountsToo) {
  Bench bench(kPir, pyroelectric({kWidePair}));
  add_warm(bench, sphere(0.1), at(3, -1), 280.0);
  EXPECT_LT(bench.sample(kSample).get<double>("flux"), 0.0);
}

TEST(Pyroelectric, APersonAsWarmAsTheAirSendsNothing) {
  Bench bench(kPir, pyroelectric({kWidePair}));
  bench.world.ambient = 299.0;
  add_warm(bench, person(), at(3, -1), 299.0);
  EXPECT_EQ(bench.sample(kSample).get<double>("flux", -1.0), 0.0);
  EXPECT_TRUE(bench.rays_cast.empty());
}

TEST(Pyroelectric, TapedZonesSeeNothing) {
  Bench bench(kPir, pyroelectric({kWidePair, {"tape", "-1 0 -1 1"}}));
  const auto id = add_warm(bench, sphere(0.1), at(3, -1), 310.0);
  EXPECT_EQ(bench.sample(kSample).get<double>("flux", -1.0), 0.0);
  bench.scene.move(id, at(3, 1));
  for (int i = 0; i < 5; ++i) bench.sample(kSample);  // what was hidden is looked for less often
  EXPECT_LT(bench.sample(kSample).get<double>("flux"), 0.0);
}

// The voltage's amplitude for a warmth that swings so often a second.
double measured_gain(double frequency) {
  Bench bench(kPir, pyroelectric({kWidePair, {"signal_threshold", "1000"}}));
  const auto id = add_warm(bench, sphere(0.1), at(3, -1), 310.0);
  bench.own_warmth = true;
  bench.scene.commit();
  double flux_high = -1.0, flux_low = 1.0, high = 0.0;
  const int turns = std::max(8, static_cast<int>(20 * frequency));
  const int samples = static_cast<int>(100.0 * turns / frequency);
  for (int i = 0; i < samples; ++i) {
    const double temperature = 310.0 + 0.5 * std::sin(2.0 * M_PI * frequency * i / 100.0);
    bench.world.warm = {{id.index, temperature, bench.scene.warm_shapes()[0].box}};
    ++bench.moves;
    const Reading reading = bench.sample(kSample);
    if (i < samples / 2) continue;
    flux_high = std::max(flux_high, reading.get<double>("flux"));
    flux_low = std::min(flux_low, reading.get<double>("flux"));
    high = std::max(high, std::abs(reading.get<double>("signal")));
  }
  return high / (0.5 * (flux_high - flux_low));
}

double closed_form(double frequency) {
  const std::complex<double> s(0.0, 2.0 * M_PI * frequency);
  const auto low = [&](double tau) { return 1.0 / (1.0 + s * tau); };
  const auto high = [&](double tau) { return s * tau / (1.0 + s * tau); };
  return std::abs(low(0.1) * high(1.6) * high(0.5 / (M_PI * 0.4)) * low(0.5 / (M_PI * 10.0)));
}

TEST(Pyroelectric, PassesTheBandOfItsTimeConstants) {
  EXPECT_NEAR(measured_gain(1.0), 3300.0, 60.0);
  for (const double frequency : {0.05, 0.2, 0.5, 2.0, 5.0}) {
    const double expected = 3300.0 * closed_form(frequency) / closed_form(1.0);
    EXPECT_NEAR(measured_gain(frequency), expected, 0.05 * expected) << frequency;
  }
}

TEST(Pyroelectric, SleepsWithoutRaysOrNoiseOnceAllIsStill) {
  Bench bench(kPir, pyroelectric({{"noise_stddev", "3e-6"}}));
  const auto id = add_warm(bench, person(), at(4, 0, -1.3), 299.0);
  bench.sample(kSample);
  bench.scene.move(id, at(4, 0.1, -1.3));
  bench.sample(kSample);
  EXPECT_NE(bench.sample(kSample).get<double>("signal"), 0.0);
  EXPECT_TRUE(bench.rays_cast.empty());
  for (int i = 0; i < 3000; ++i) bench.sample(kSample);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(bench.sample(kSample).get<double>("signal", -1.0), 0.0);
}

TEST(Pyroelectric, NoiseIsThatOfTheSdfAndOfTheSeed) {
  const auto signals = [](std::uint64_t seed) {
    Bench bench(kPir, pyroelectric({kWidePair, {"noise_stddev", "5e-6"}}));
    bench.seed = seed;
    add_warm(bench, sphere(0.02), at(3, 0, 2.9), 310.0);
    std::vector<double> all;
    const auto id = add_warm(bench, sphere(0.001), at(3, -1), 300.0);
    for (int i = 0; i < 4000; ++i) {
      bench.scene.move(id, at(3, -1 + 1e-5 * i));  // nothing to speak of, but it never rests
      all.push_back(bench.sample(kSample).get<double>("signal"));
    }
    return all;
  };
  const std::vector<double> first = signals(1);
  double sum = 0.0;
  for (const double v : first) sum += v * v;
  EXPECT_NEAR(std::sqrt(sum / 4000.0), 5e-6, 0.3e-6);
  EXPECT_EQ(first, signals(1));
  EXPECT_NE(first, signals(2));
}

/// How many samples the output is off, then on, then off, … with a comparator that fires at every
/// sample while something moves: for `moving` samples of `all`.
std::vector<int> run_lengths(Parameters more, int moving, int all) {
  more.push_back(kWidePair);
  more.emplace_back("noise_stddev", "1e-3");
  more.emplace_back("signal_threshold", "1e-12");
  more.emplace_back("rest_threshold", "1");  // asleep at once when nothing moves
  Bench bench(kPir, pyroelectric(more));
  const auto id = add_warm(bench, sphere(0.1), at(3, -1), 310.0);
  std::vector<int> lengths{0};
  for (int i = 0; i < all; ++i) {
    if (i < moving) bench.scene.move(id, at(3, -1 + 1e-3 * i));
    const bool on = bench.sample(kSample).get<bool>("motion");
    if (on != (lengths.size() % 2 == 0)) lengths.push_back(0);
    ++lengths.back();
  }
  return lengths;
}

// The first sample is never motion: there is none before it.
TEST(Pyroelectric, IsOnForTheHoldTimeAndThenDeafForTheBlockingTime) {
  const std::vector<int> lengths =
      run_lengths({{"hold_time", "0.5"}, {"blocking_time", "1"}, {"retrigger", "false"}}, 400, 400);
  EXPECT_EQ(lengths, (std::vector<int>{1, 50, 100, 50, 100, 50, 49}));
}

TEST(Pyroelectric, EachCrossingProlongsMotionWhereItRetriggers) {
  const std::vector<int> lengths = run_lengths({{"hold_time", "0.5"}}, 200, 400);
  // The last one that fires is sample 199, the 200th.
  EXPECT_EQ(lengths, (std::vector<int>{1, 198 + 50, 151}));
}

TEST(Pyroelectric, IsDeafWhileItWarmsUp) {
  const std::vector<int> lengths = run_lengths(Parameters{{"warm_up", "2"}}, 400, 300);
  EXPECT_EQ(lengths, (std::vector<int>{200, 100}));
}

TEST(Pyroelectric, FalseAlarmsComeAtTheirRate) {
  Bench bench(
      kPir,
      pyroelectric({{"false_alarm_rate", "3600"}, {"hold_time", "0.01"}, {"blocking_time", "0"}}));
  int alarms = 0;
  for (int i = 0; i < 36'000; ++i) {
    const Reading reading = bench.sample(kSample);
    if (reading.event != "motion") continue;
    ++alarms;
    EXPECT_EQ(reading.event_detail, "false alarm");
  }
  EXPECT_NEAR(alarms, 360, 57);  // three standard deviations
}

/// Whether a person is seen who walks by at `distance` m, or towards the detector from there.
bool seen(double distance, double speed, bool towards, const Parameters& more = {}) {
  Bench bench(kPir, pyroelectric(more));
  const double z = 0.875 - 2.2;
  const auto id = add_warm(bench, person(), at(distance, -50.0, z), 299.0);
  bench.sample(kSample);
  const int samples = static_cast<int>(3.0 / speed * 100.0);
  for (int i = 0; i <= samples; ++i) {
    const double way = -1.5 + speed * i / 100.0;
    const double left = distance - 1.5 - way;
    bench.scene.move(id, towards ? at(left, 0.06 * left, z) : at(distance, way, z));
    // It appears where it begins: what that does is over before it counts.
    if (i == 0) {
      for (int k = 0; k < 3000; ++k) bench.sample(kSample);
    }
    if (bench.sample(kSample).get<bool>("motion")) return true;
  }
  return false;
}

double reach(bool towards) {
  double distance = 2.0;
  while (distance < 19.5 && seen(distance + 0.5, 1.0, towards)) distance += 0.5;
  return distance;
}

TEST(Pyroelectric, SeesWhoCrossesItsViewFromFartherThanWhoComesTowardsIt) {
  const double tangential = reach(false);
  const double radial = reach(true);
  RecordProperty("tangential", std::to_string(tangential));
  RecordProperty("radial", std::to_string(radial));
  EXPECT_GT(tangential, radial + 1.0);
  EXPECT_GE(tangential, 12.0);
}

TEST(Pyroelectric, MissesWhoMovesTooSlowlyOrTooFastForItsBand) {
  // At 10 m a pair of the lens' first row is 1.5 m wide: 0.013, 0.7 and 70 crossings a second.
  EXPECT_FALSE(seen(10.0, 0.02, false));
  EXPECT_TRUE(seen(10.0, 1.0, false));
  EXPECT_FALSE(seen(10.0, 100.0, false));
}

TEST(Pyroelectric, TheRatedObjectIsSeenAtTheRatedRange) {
  // 0.7 x 0.25 m, 4 K, 1 m/s at 12 m: what the maker of the default lens rates it with.
  Bench bench(kPir,
              plugin_element({{"model", "pyroelectric"}, {"noise_stddev", "0"}, {"warm_up", "0"}}));
  const auto id = add_warm(bench, box(0.25, 0.25, 0.7), at(12.0, -2.0, -1.13), 299.15);
  double greatest = 0.0;
  for (int i = 0; i < 400; ++i) {
    bench.scene.move(id, at(12.0, -2.0 + 0.01 * i, -1.13));
    greatest = std::max(greatest, std::abs(bench.sample(kSample).get<double>("signal")));
  }
  RecordProperty("microvolts", std::to_string(1e6 * greatest));
  EXPECT_GT(greatest, 3e-4);
  EXPECT_LT(greatest, 1.3 * 3e-4);
}

TEST(Pyroelectric, RefusesWhatMakesNoSense) {
  const auto complaint = [](const char* key, const char* value) {
    return test::complaint_of(kPir, plugin_element({{"model", "pyroelectric"}, {key, value}}));
  };
  EXPECT_NE(complaint("lens", "round"), "");
  EXPECT_NE(complaint("zone_row", "2 1 -1 0 1"), "");
  EXPECT_NE(complaint("zone_row", "1.5 -1 1 0 1"), "");
  EXPECT_NE(complaint("tape", "0 1 1 0"), "");
  EXPECT_NE(complaint("sample_rate", "10"), "");
  EXPECT_NE(complaint("hold_time", "-1"), "");
  EXPECT_NE(complaint("threshold", "0.1"), "");  // range_difference's
  EXPECT_EQ(complaint("tape", "0 1 0 1"), "");
}

}  // namespace
}  // namespace angen
