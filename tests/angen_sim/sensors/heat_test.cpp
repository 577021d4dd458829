#include <gtest/gtest.h>

#include <cmath>

#include "warm_bench.h"

namespace angen::test {
namespace {

double contrast(double temperature, double air) {
  return 5.670374419e-8 / M_PI * (std::pow(temperature, 4) - std::pow(air, 4));
}

TEST(Heat, TheFluxOfASphereIsItsRadianceTimesItsSolidAngle) {
  Bench bench(kPir, pyroelectric({kWidePair}));
  const double yaw = -0.4;  // the middle of the positive zone
  const double sine = 0.1 / 3.0;
  add_warm(bench, sphere(0.1), at(3.0 * std::cos(yaw), 3.0 * std::sin(yaw)), 310.0);
  const double expected = kOpening * contrast(310.0, 295.15) * M_PI * sine * sine;
  EXPECT_NEAR(bench.sample(kSample).get<double>("flux"), expected, 0.03 * expected);
}

TEST(Heat, TheElementsAreSubtracted) {
  Bench bench(kPir, pyroelectric({kWidePair}));
  const auto id = add_warm(bench, sphere(0.1), at(3, -1), 310.0);
  const double right = bench.sample(kSample).get<double>("flux");
  EXPECT_GT(right, 0.0);
  bench.scene.move(id, at(3, 1));
  EXPECT_NEAR(bench.sample(kSample).get<double>("flux"), -right, 0.02 * right);
  bench.scene.move(id, at(3, 0));  // the gap between the two
  EXPECT_NEAR(bench.sample(kSample).get<double>("flux"), 0.0, 0.02 * right);
}

TEST(Heat, WallsAndFurnitureHideWhatIsWarm) {
  Bench bench(kPir, pyroelectric({kWidePair}));
  add_warm(bench, sphere(0.1), at(3, -1), 310.0);
  const double whole = bench.sample(kSample).get<double>("flux");
  const auto shelf = bench.add(box(0.1, 4, 1), at(2, 0, -0.5));
  EXPECT_NEAR(bench.sample(kSample).get<double>("flux"), 0.5 * whole, 0.07 * whole);
  bench.scene.move(shelf, at(2, 0, 0));
  EXPECT_EQ(bench.sample(kSample).get<double>("flux", -1.0), 0.0);
}

TEST(Heat, WhatIsColderThanTheAirCountsToo) {
  Bench bench(kPir, pyroelectric({kWidePair}));
  add_warm(bench, sphere(0.1), at(3, -1), 280.0);
  EXPECT_LT(bench.sample(kSample).get<double>("flux"), 0.0);
}

TEST(Heat, APersonAsWarmAsTheAirSendsNothing) {
  Bench bench(kPir, pyroelectric({kWidePair}));
  bench.world.ambient = 299.0;
  add_warm(bench, person(), at(3, -1), 299.0);
  EXPECT_EQ(bench.sample(kSample).get<double>("flux", -1.0), 0.0);
  EXPECT_EQ(bench.world.ray_queries, 0);
}

TEST(Heat, TapedZonesSeeNothing) {
  Bench bench(kPir, pyroelectric({kWidePair, {"tape", "-1 0 -1 1"}}));
  const auto id = add_warm(bench, sphere(0.1), at(3, -1), 310.0);
  EXPECT_EQ(bench.sample(kSample).get<double>("flux", -1.0), 0.0);
  bench.scene.move(id, at(3, 1));
  for (int i = 0; i < 5; ++i) bench.sample(kSample);  // hidden surfaces are tested less often
  EXPECT_LT(bench.sample(kSample).get<double>("flux"), 0.0);
}

}  // namespace
}  // namespace angen::test
