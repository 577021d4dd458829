// Soft limits of joints, as URDF states them.
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "physics/joints.h"

namespace angen::physics::testing {
namespace {

using Type = desc::Joint::Type;

/// A mass of 2 kg that slides along x, with a <safety_controller>.
desc::Model guarded_slider(const desc::JointSafety& safety) {
  desc::Model model = model_of("slider", {ghost_link("mass", 2.0, {0.1, 0.1, 0.1})});
  model.joints = {joint_of(Type::kPrismatic, "world", "mass", Vec3::UnitX())};
  desc::JointAxis& axis = model.joints[0].axes[0];
  axis.effort = 20.0;
  axis.velocity = 3.0;
  axis.safety = safety;
  return model;
}

Joint guarded_joint(double position) {
  Joint joint;
  joint.type = Type::kPrismatic;
  joint.position = position;
  joint.axes.resize(1);
  joint.axes[0].effort = 20.0;
  joint.axes[0].velocity = 3.0;
  joint.axes[0].safety = desc::JointSafety{-0.5, 1.0, 4.0, 50.0};
  return joint;
}

// v- = -k_position (x - x-), v+ = -k_position (x - x+), within the velocity limit; the effort's
// bounds are -k_velocity (v - v-) and -k_velocity (v - v+), within the effort limit.
TEST(JointSafety, BoundsFollowTheFormula) {
  const Joint middle = guarded_joint(0.0);
  EXPECT_DOUBLE_EQ(velocity_bounds(middle).low, -2.0);
  EXPECT_DOUBLE_EQ(velocity_bounds(middle).high, 3.0) << "4, but for the velocity limit";
  EXPECT_NEAR(effort_bounds(middle, 2.8).high, 10.0, 1e-9);
  EXPECT_DOUBLE_EQ(effort_bounds(middle, 2.8).low, -20.0) << "-240, but for the effort limit";
  EXPECT_NEAR(effort_bounds(middle, -2.1).low, 5.0, 1e-9) << "faster than its bound: pushed back";
  const Joint near = guarded_joint(0.9);
  EXPECT_NEAR(velocity_bounds(near).high, 0.4, 1e-12);
  EXPECT_NEAR(effort_bounds(near, 0.3).high, 5.0, 1e-12);
  const Joint beyond = guarded_joint(1.05);
  EXPECT_NEAR(velocity_bounds(beyond).high, -0.2, 1e-12);
  EXPECT_NEAR(effort_bounds(beyond, 0.0).high, -10.0, 1e-12);
}

TEST(JointSafety, WithoutPositionGainOnlyTheVelocityLimitBounds) {
  Joint joint = guarded_joint(7.0);
  joint.axes[0].safety->k_position = 0.0;
  EXPECT_DOUBLE_EQ(velocity_bounds(joint).high, 3.0);
  EXPECT_NEAR(effort_bounds(joint, 2.9).high, 5.0, 1e-9);
  joint.axes[0].safety->k_velocity = 0.0;
  EXPECT_DOUBLE_EQ(effort_bounds(joint, 2.9).high, 20.0);
}

// While its effort is bounded, m x'' = -k_v (x' - v+): two exponentials, here of 5/s and 20/s.
TEST(JointSafety, AForceBringsItToTheSoftLimitAndNotBeyond) {
  TestWorld world;
  const ModelId id = world.add(guarded_slider({-0.5, 1.0, 4.0, 50.0}));
  const JointId joint = world.joints(id)[0];
  double begin = -1.0;
  double from = 0.0;
  double speed = 0.0;
  double worst = 0.0;
  double farthest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const JointState now = world.joint(joint);
    const double left = 1.0 - now.position;
    if (begin < 0.0 && 50.0 * (4.0 * left - now.velocity) < 15.0) {
      begin = i * kStep;
      from = left;
      speed = -now.velocity;
    }
    if (begin >= 0.0) {
      const double t = i * kStep - begin;
      const double slow = (20.0 * from + speed) / 15.0;
      const double exact = slow * std::exp(-5.0 * t) + (from - slow) * std::exp(-20.0 * t);
      worst = std::max(worst, std::abs(left - exact));
    }
    farthest = std::max(farthest, now.position);
    world.add_force(joint, 15.0);
    world.run(kStep);
  }
  printf("safety: bounded from %.3f m before the soft limit; off the closed form by %.2f mm\n",
         from, 1000.0 * worst);
  ASSERT_GT(begin, 0.0);
  EXPECT_LT(worst, 0.001);
  EXPECT_LT(farthest, 1.0);
  EXPECT_GT(farthest, 0.998);
}

// A motor's speed is bounded by v+ alone: x+ - x falls as exp(-k_position t).
TEST(JointSafety, AMotorSlowsDownBeforeTheSoftLimit) {
  TestWorld world;
  const ModelId id = world.add(guarded_slider({-0.5, 1.0, 4.0, 50.0}));
  const JointId joint = world.joints(id)[0];
  world.set_motor(joint, 2.0, 1000.0);
  world.run(0.6);
  const double left = 1.0 - world.joint(joint).position;
  EXPECT_NEAR(left, 0.5 * std::exp(-4.0 * (0.6 - 0.35)), 0.005)
      << "at 10 m/s^2 to 2 m/s, and bounded from half a meter on";
  world.run(0.5);
  EXPECT_NEAR(1.0 - world.joint(joint).position, left * std::exp(-4.0 * 0.5), 0.01 * left);
}

TEST(JointSafety, WhatIsBeyondIsBroughtBackByItsBrake) {
  TestWorld world;
  desc::Model model = guarded_slider({-0.5, 1.0, 4.0, 50.0});
  model.joints[0].axes[0].initial_position = 1.2;
  const ModelId id = world.add(model);
  world.set_motor(world.joints(id)[0], 0.0, 1000.0);
  world.run(2.0);
  EXPECT_NEAR(world.joint(world.joints(id)[0]).position, 1.0, 0.001);
}

}  // namespace
}  // namespace angen::physics::testing
