#include "sensors/path_loss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace angen::sensors {
namespace {

constexpr double kFrequency = 2440.0;  // MHz

rays::Crossing crossing(double enter, double leave, Eigen::Vector3f normal = {-1, 0, 0}) {
  return {enter, leave, 0, normal};
}

Obstacles along_x(const std::vector<rays::Crossing>& crossings) {
  return obstacles_on(crossings, Vec3::UnitX());
}

// 32.45 + 20 lg(d/km) + 20 lg(f/MHz)
TEST(PathLoss, FreeSpace) {
  EXPECT_NEAR(free_space_loss(1.0, kFrequency), 32.45 - 60.0 + 20.0 * std::log10(kFrequency), 0.01);
  EXPECT_NEAR(free_space_loss(20.0, kFrequency) - free_space_loss(2.0, kFrequency), 20.0, 1e-9);
  EXPECT_EQ(free_space_loss(0.0, kFrequency), free_space_loss(0.1, kFrequency));
}

TEST(PathLoss, WallsCountByTheirThickness) {
  const Obstacles found = along_x({crossing(1.0, 1.005), crossing(2.0, 2.04), crossing(3.0, 3.1),
                                   crossing(4.0, 4.24), crossing(5.0, 5.6)});
  EXPECT_EQ(found.light, 3);  // a leaf, a partition, and a wardrobe
  EXPECT_EQ(found.heavy, 1);
  EXPECT_EQ(found.floors, 0);
  EXPECT_NEAR(loss_of(found, {}), 3 * 3.4 + 6.9, 1e-12);
}

TEST(PathLoss, AnObliquePathThroughAWallCrossesThatWall) {
  const Vec3 way = Vec3(0.2, 0.0, 1.0).normalized();
  const double inside = 0.1 / way.x();  // 0.51 m of a wall of 0.1 m
  EXPECT_EQ(obstacles_on({crossing(1.0, 1.0 + inside)}, way).light, 1);
  EXPECT_EQ(obstacles_on({crossing(1.0, 1.0 + 0.2 / way.z(), {0, 0, -1})}, way).floors, 1);
}

TEST(PathLoss, ShapesThatOverlapOrTouchAreOne) {
  EXPECT_EQ(along_x({crossing(1.0, 1.1), crossing(1.05, 1.12)}).light, 1);
  EXPECT_EQ(along_x({crossing(1.0, 1.05), crossing(1.05, 1.1)}).light, 1) << "two boards";
  EXPECT_EQ(along_x({crossing(1.0, 1.1), crossing(1.1, 1.2)}).heavy, 1) << "a wall of 0.2 m";
  EXPECT_EQ(along_x({crossing(1.0, 1.1), crossing(1.11, 1.2)}).light, 2) << "a gap";
  EXPECT_EQ(along_x({crossing(1.0, 1.1), crossing(1.1, 1.2, {0, 0, -1})}).light, 1) << "a shelf";
  EXPECT_EQ(along_x({crossing(1.0, 1.2), crossing(1.2, 1.8)}).heavy, 1) << "a wardrobe at it";
  EXPECT_EQ(along_x({crossing(1.0, 1.1), crossing(1.02, 1.05), crossing(1.09, 1.3)}).heavy, 1);
}

// COST 231: 18.3 dB of one floor, and less than twice that of two.
TEST(PathLoss, FurtherFloorsAddLess) {
  EXPECT_NEAR(loss_of({0, 0, 1}, {}), 18.3, 1e-9);
  EXPECT_NEAR(loss_of({0, 0, 2}, {}), 18.3 * std::pow(2.0, 4.0 / 3.0 - 0.46), 1e-9);
  EXPECT_NEAR(loss_of({0, 0, 3}, {}), 18.3 * std::pow(3.0, 5.0 / 4.0 - 0.46), 1e-9);
  EXPECT_LT(loss_of({0, 0, 2}, {}), 2 * 18.3);
}

}  // namespace
}  // namespace angen::sensors
