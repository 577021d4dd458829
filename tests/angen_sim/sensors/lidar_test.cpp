#include <gtest/gtest.h>

#include <cmath>

#include "bench.h"

namespace angen {
namespace {

using test::at;
using test::Bench;
using test::box;
using test::element;
using test::plugin_element;

const char* const kLidar = "libgazebo_ros_laser.so";

/// A <sensor> with `rays` rays within ±0.6 rad, 0.1 to 8 m.
Element fan(int rays, double noise_stddev = 0.0) {
  const Element scan = element("scan", "", {test::scan("horizontal", rays, -0.6, 0.6)});
  const Element range = element("range", "", {element("min", "0.1"), element("max", "8")});
  return test::sensor_element({element("ray", "", {scan, range, test::noise(noise_stddev)})});
}

std::vector<double> ranges_of(const Reading& reading) {
  return reading.get<std::vector<double>>("ranges");
}

TEST(Lidar, MeasuresAFlatWallAtItsDistanceOverTheCosine) {
  Bench bench(kLidar, plugin_element({}), fan(121));
  bench.add(box(1, 30, 30), at(3.5));  // its face is 3 m away
  const Reading reading = bench.sample();
  const std::vector<double> ranges = ranges_of(reading);
  ASSERT_EQ(ranges.size(), 121U);
  const double first = reading.get<double>("angle_min");
  const double step = reading.get<double>("angle_increment");
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    EXPECT_NEAR(ranges[i], 3.0 / std::cos(first + static_cast<double>(i) * step), 1e-9);
  }
  EXPECT_NEAR(first + 120 * step, reading.get<double>("angle_max"), 1e-12);
}

TEST(Lidar, ARayThatMeetsNothingIsInfinite) {
  Bench bench(kLidar, plugin_element({}), fan(3, 0.05));
  bench.add(box(1, 0.5, 1), at(3.5));  // in the middle ray's way only
  const std::vector<double> ranges = ranges_of(bench.sample());
  EXPECT_TRUE(std::isinf(ranges[0]) && ranges[0] > 0.0);
  EXPECT_NEAR(ranges[1], 3.0, 0.3);
  EXPECT_TRUE(std::isinf(ranges[2]) && ranges[2] > 0.0);
}

TEST(Lidar, FartherThanItsRangeIsNotSeen) {
  Bench bench(kLidar, plugin_element({}), fan(1));
  const auto wall = bench.add(box(1, 1, 1), at(8.51));
  EXPECT_TRUE(std::isinf(ranges_of(bench.sample())[0]));
  bench.scene.move(wall, at(8.49));
  EXPECT_NEAR(ranges_of(bench.sample())[0], 7.99, 1e-9);
}

TEST(Lidar, NoiseHasTheStandardDeviationThatWasAskedFor) {
  Bench bench(kLidar, plugin_element({}), fan(1000, 0.02));
  bench.add(box(1, 30, 30), at(3.5));
  double sum = 0.0, squares = 0.0;
  const std::vector<double> ranges = ranges_of(bench.sample());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double angle = -0.6 + 1.2 * static_cast<double>(i) / 999.0;
    const double error = ranges[i] - 3.0 / std::cos(angle);
    sum += error;
    squares += error * error;
  }
  // Four standard errors of a mean and of a standard deviation of 1000 values.
  EXPECT_NEAR(sum / 1000, 0.0, 4 * 0.02 / std::sqrt(1000.0));
  EXPECT_NEAR(std::sqrt(squares / 1000), 0.02, 4 * 0.02 / std::sqrt(2000.0));
}

TEST(Lidar, LooksOnDemandTenTimesASecondAllRound) {
  Bench bench(kLidar);
  EXPECT_TRUE(bench.kind().is_on_demand);
  EXPECT_EQ(bench.kind().rate(), 10.0);
  const Reading reading = bench.sample();
  EXPECT_EQ(ranges_of(reading).size(), 360U);
  EXPECT_NEAR(360 * reading.get<double>("angle_increment"), 2 * M_PI, 1e-9);
}

TEST(Lidar, HasOneRowOfRays) {
  const Element scan = element("scan", "", {test::scan("vertical", 2, -0.1, 0.1)});
  const Element sensor = test::sensor_element({element("ray", "", {scan})});
  EXPECT_NE(test::complaint_of(kLidar, plugin_element({}), sensor).find("must have 1"),
            std::string::npos);
}

}  // namespace
}  // namespace angen
