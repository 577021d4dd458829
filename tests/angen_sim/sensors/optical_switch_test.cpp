#include <gtest/gtest.h>

#include "bench.h"

namespace angen {
namespace {

using test::at;
using test::Bench;
using test::box;
using test::element;
using test::plugin_element;

const char* const kSwitch = "liboptical_switch_controller.so";
constexpr Nanoseconds kSamplePeriod = 10'000'000;

Element noisy(double stddev) {
  return test::sensor_element({element("ray", "", {test::noise(stddev)})});
}

TEST(OpticalSwitch, LooksAHundredTimesASecondAndPublishesOnce) {
  const Bench usual(kSwitch);
  EXPECT_EQ(usual.sensor().sample_period(), kSamplePeriod);
  EXPECT_EQ(usual.kind().rate(), 1.0);
  const Bench slow(kSwitch, plugin_element({{"sample_rate", "50"}}));
  EXPECT_EQ(slow.sensor().sample_period(), 2 * kSamplePeriod);
}

TEST(OpticalSwitch, IsClosedWhileTheBeamIsCut) {
  Bench bench(kSwitch);
  const Reading open = bench.sample(kSamplePeriod);
  EXPECT_FALSE(open.get<bool>("closed", true));
  EXPECT_EQ(open.get<std::vector<double>>("ranges"), (std::vector<double>{0.5, 0.5}));
  bench.add(box(0.02, 0.1, 0.1), at(0.25));
  const Reading closed = bench.sample(kSamplePeriod);
  EXPECT_TRUE(closed.get<bool>("closed"));
  EXPECT_NEAR(closed.get<std::vector<double>>("ranges").at(0), 0.24, 1e-3);
  EXPECT_TRUE(bench.sample(kSamplePeriod).get<bool>("closed"));
}

TEST(OpticalSwitch, SendsAtOnceOnAChangeOnly) {
  Bench bench(kSwitch);
  EXPECT_FALSE(bench.sample(kSamplePeriod).urgent);
  const auto strip = bench.add(box(0.02, 0.1, 0.1), at(0.25));
  const Reading cut = bench.sample(kSamplePeriod);
  EXPECT_TRUE(cut.urgent);
  EXPECT_TRUE(cut.get<bool>("changed"));
  EXPECT_EQ(cut.event, "closed");
  EXPECT_NEAR(cut.get<double>("difference"), 0.26, 1e-3);
  const Reading after = bench.sample(kSamplePeriod);
  EXPECT_FALSE(after.urgent);
  EXPECT_FALSE(after.get<bool>("changed", true));
  EXPECT_EQ(after.event, "");
  bench.scene.remove(strip);
  const Reading freed = bench.sample(kSamplePeriod);
  EXPECT_TRUE(freed.urgent);
  EXPECT_EQ(freed.event, "opened");
}

TEST(OpticalSwitch, OneRayIsEnough) {
  Bench bench(kSwitch);
  bench.add(box(0.02, 0.1, 0.1), at(0.4, 0.052));  // only the left ray, 8 mm off the axis there
  const Reading reading = bench.sample(kSamplePeriod);
  EXPECT_TRUE(reading.get<bool>("closed"));
  EXPECT_EQ(reading.get<std::vector<double>>("ranges").at(0), 0.5);
  EXPECT_LT(reading.get<std::vector<double>>("ranges").at(1), 0.4);
}

TEST(OpticalSwitch, ADetectorThatIsSolidIsNoObstacle) {
  Bench bench(kSwitch, plugin_element({{"beam_length", "0.3"}}));
  bench.add(box(0.02, 0.1, 0.1), at(0.31));
  EXPECT_FALSE(bench.sample(kSamplePeriod).get<bool>("closed", true));
  bench.add(box(0.02, 0.1, 0.1), at(0.15));
  EXPECT_TRUE(bench.sample(kSamplePeriod).get<bool>("closed"));
}

TEST(OpticalSwitch, NoiseChangesNothing) {
  Bench bench(kSwitch, plugin_element({}), noisy(0.005));
  bench.add(box(0.02, 0.1, 0.1), at(0.25));
  bench.sample(kSamplePeriod);
  double greatest = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    const Reading reading = bench.sample(kSamplePeriod);
    ASSERT_TRUE(reading.get<bool>("closed"));
    ASSERT_FALSE(reading.urgent);
    greatest = std::max(greatest, reading.get<double>("difference"));
  }
  EXPECT_GT(greatest, 0.02);
}

TEST(OpticalSwitch, StartsClosedWithoutAnEvent) {
  Bench bench(kSwitch);
  bench.add(box(0.02, 0.1, 0.1), at(0.25));
  const Reading reading = bench.sample(kSamplePeriod);
  EXPECT_TRUE(reading.get<bool>("closed"));
  EXPECT_EQ(reading.event, "");
  EXPECT_FALSE(reading.urgent);
}

TEST(OpticalSwitch, HasTwoRays) {
  const Element three = test::sensor_element(
      {element("ray", "", {element("scan", "", {test::scan("horizontal", 3, -0.1, 0.1)})})});
  EXPECT_EQ(test::complaint_of(kSwitch, plugin_element({}), three),
            "test.sdf:1: an optical switch has 3 rays, must have 2");
  EXPECT_NE(test::complaint_of(kSwitch, plugin_element({{"beam_length", "0.6"}})), "");
}

}  // namespace
}  // namespace angen
