#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "models.h"

namespace angen::physics::testing {
namespace {

constexpr double kHalf = 0.1;

desc::Model floor_that_bounces() {
  desc::Model floor = floor_model();
  floor.links[0].collisions[0].restitution = 1.0;
  return floor;
}

desc::Model bouncer(double restitution, double height, bool ball) {
  const Vec3 size = Vec3::Constant(2 * kHalf);
  desc::Model model = box_model("bouncer", 1.0, size, {0, 0, kHalf + height});
  if (ball) model.links[0].collisions[0].shape = round_shape(Shape::Type::kSphere, kHalf);
  model.links[0].collisions[0].restitution = restitution;
  return model;
}

/// Heights of the tops of the first bounces, m.
std::vector<double> bounces(double restitution, double height, bool ball, std::size_t count) {
  TestWorld world;
  world.add(floor_that_bounces());
  const LinkId link = world.only_link(world.add(bouncer(restitution, height, ball)));
  std::vector<double> tops;
  double before = -1.0;
  for (int i = 0; i < 20000 && tops.size() < count; ++i) {
    world.run(kStep);
    const double speed = world.link(link).linear_velocity.z();
    if (before > 0.0 && speed <= 0.0) tops.push_back(world.link(link).pose.position.z() - kHalf);
    before = speed;
  }
  return tops;
}

TEST(Bounce, EachTopIsTheSquareOfTheRestitutionTimesTheOneBefore) {
  double worst = 0.0;
  for (const bool ball : {true, false}) {
    for (const double height : {0.3, 1.0, 2.7}) {
      for (const double restitution : {0.5, 0.8, 1.0}) {
        const std::vector<double> tops = bounces(restitution, height, ball, 3);
        ASSERT_EQ(tops.size(), 3U);
        for (int n = 1; n <= 3; ++n) {
          const double exact = std::pow(restitution, 2 * n) * height;
          worst = std::max(worst, std::abs(tops[n - 1] / exact - 1.0));
          EXPECT_NEAR(tops[n - 1], exact, 0.01 * exact) << restitution << " from " << height;
        }
      }
    }
  }
  printf("3 bounces reach the closed form's heights within %.3f %%\n", 100 * worst);
}

TEST(Bounce, TwoThatCollideExchangeTheirSpeedsWithoutGravity) {
  TestWorld world({}, Vec3::Zero());
  desc::Model one = bouncer(0.5, 0.0, true);
  desc::Model two = bouncer(0.5, 1.0, true);
  two.name = "other";
  two.links[0].inertial.mass = 3.0;
  const LinkId low = world.only_link(world.add(one));
  const LinkId high = world.only_link(world.add(two));
  world.set_velocity(low, {0, 0, 2.0}, Vec3::Zero());
  world.run(1.0);
  EXPECT_NEAR(world.link(low).linear_velocity.z(), 2.0 * (1.0 - 0.5 * 3.0) / 4.0, 1e-3);
  EXPECT_NEAR(world.link(high).linear_velocity.z(), 2.0 * 1.5 / 4.0, 1e-3);
}

TEST(Bounce, WhatBouncesComesToRestAtLast) {
  TestWorld world;
  world.add(floor_that_bounces());
  const LinkId link = world.only_link(world.add(bouncer(0.7, 1.0, false)));
  world.run(6.0);
  EXPECT_FALSE(world.awake(link));
  EXPECT_NEAR(world.link(link).pose.position.z(), kHalf, 1e-3);
}

}  // namespace
}  // namespace angen::physics::testing
