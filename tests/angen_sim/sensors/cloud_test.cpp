#include "sensors/cloud.h"

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
using Numbers = std::vector<double>;

const char* const kBlock = "libgazebo_ros_block_laser.so";
const char* const kVelodyne = "libgazebo_ros_velodyne_laser.so";

/// 31 x 5 rays within 0.6 and 0.2 rad, 0.1 to 8 m.
Element fan(double noise = 0.0) {
  const Element scan = element(
      "scan", "", {test::scan("horizontal", 31, -0.6, 0.6), test::scan("vertical", 5, -0.2, 0.2)});
  const Element range = element("range", "", {element("min", "0.1"), element("max", "8")});
  return test::sensor_element({element("ray", "", {scan, range, test::noise(noise)})});
}

TEST(Cloud, MeasuresAFlatWallInAllItsRows) {
  for (const char* library : {kBlock, kVelodyne}) {
    Bench bench(library, plugin_element({}), fan());
    bench.albedo = {0.2F, 0.4F, 0.6F};
    bench.add(box(1, 30, 30), at(3.5));  // its face is 3 m away
    const Reading reading = bench.sample();
    const auto ranges = reading.get<Numbers>("ranges");
    const auto intensities = reading.get<Numbers>("intensities");
    ASSERT_EQ(ranges.size(), 31U * 5U);
    for (int row = 0; row < 5; ++row) {
      for (int column = 0; column < 31; ++column) {
        const double left = -0.6 + 1.2 * column / 30;
        const double up = -0.2 + 0.4 * row / 4;
        const std::size_t i = static_cast<std::size_t>(row) * 31 + column;
        ASSERT_NEAR(ranges[i], 3.0 / (std::cos(left) * std::cos(up)), 1e-9);
        ASSERT_NEAR(intensities[i], 40.0, 1e-4);
      }
    }
  }
}

TEST(Cloud, NothingInReachIsInfinite) {
  Bench bench(kBlock, plugin_element({}), fan());
  bench.add(box(1, 30, 30), at(9.5));
  const auto ranges = bench.sample().get<Numbers>("ranges");
  EXPECT_TRUE(std::isinf(ranges[2 * 31 + 15]));
}

TEST(Cloud, AVelodyneSeesBetweenItsOwnRangesToo) {
  Bench near(kVelodyne, plugin_element({{"max_range", "2"}}), fan());
  near.add(box(1, 30, 30), at(3.5));
  EXPECT_TRUE(std::isinf(near.sample().get<Numbers>("ranges")[77]));
  Bench far(kVelodyne, plugin_element({{"min_range", "3.5"}}), fan());
  far.add(box(1, 30, 30), at(3.5));
  EXPECT_TRUE(std::isinf(far.sample().get<Numbers>("ranges")[77])) << "it hides its far side";
  Bench through(kVelodyne, plugin_element({{"min_range", "3.5"}, {"near_blocks", "false"}}), fan());
  through.add(box(1, 30, 30), at(3.5));
  EXPECT_NEAR(through.sample().get<Numbers>("ranges")[77], 4.0, 1e-9) << "the far side of the box";
  Bench dark(kVelodyne, plugin_element({{"min_intensity", "60"}}), fan());
  dark.albedo.setConstant(0.5F);
  dark.add(box(1, 30, 30), at(3.5));
  EXPECT_TRUE(std::isinf(dark.sample().get<Numbers>("ranges")[77]));
}

TEST(Cloud, NoiseIsThatOfTheRaysAndThePlugin) {
  Bench bench(kBlock, plugin_element({{"gaussianNoise", "0.03"}}), fan(0.04));
  bench.add(box(1, 30, 30), at(3.5));
  double squares = 0.0;
  for (int i = 0; i < 2000; ++i) {
    squares += std::pow(bench.sample().get<Numbers>("ranges")[77] - 3.0, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / 2000), 0.05, 0.004);
}

}  // namespace
}  // namespace angen
