// Springs and latches on joints.
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "physics/joints.h"

namespace angen::physics::testing {
namespace {

using Type = desc::Joint::Type;

/// A wheel of 1/150 kg m^2 on a spring of `hertz`, 0.5 rad from where the spring is slack.
desc::Model sprung_wheel(double hertz, double damping_ratio, double reference = 0.0) {
  desc::Model model = model_of("wheel", {ghost_link("w", 1.0, {0.2, 0.2, 0.2})});
  model.joints = {joint_of(Type::kRevolute, "world", "w")};
  const double inertia = 0.08 / 12.0;
  const double omega = 2.0 * M_PI * hertz;
  desc::JointAxis& axis = model.joints[0].axes[0];
  axis.spring_stiffness = inertia * omega * omega;
  axis.spring_reference = reference;
  axis.damping = 2.0 * damping_ratio * inertia * omega;
  axis.initial_position = reference + 0.5;
  return model;
}

TEST(Springs, SwingWithTheirPeriodAndKeepTheirAmplitude) {
  for (const double hertz : {0.5, 1.0, 10.0}) {
    TestWorld world({}, Vec3::Zero());
    const JointId joint = world.joints(world.add(sprung_wheel(hertz, 0.0, 0.3)))[0];
    double most = 0.0;
    world.run(10.0 / hertz - 0.25 / hertz);  // the tenth time through the middle, going up
    double last = world.joint(joint).position - 0.3;
    double crossed = 0.0;
    for (double t = 0.0; t < 1.0 / hertz; t += kStep) {
      world.run(kStep);
      const double now = world.joint(joint).position - 0.3;
      if (last < 0.0 && now >= 0.0) crossed = t + kStep * last / (last - now);
      most = std::max(most, std::abs(now));
      last = now;
    }
    printf("spring of %.1f Hz: amplitude %.5f of 0.5 rad after 10 periods, %.5f s late\n", hertz,
           most, crossed);
    EXPECT_NEAR(most, 0.5, 0.5 * 0.002 + 0.5 * M_PI * hertz * kStep);
  }
}

TEST(Springs, PeriodIsThatOfTheEquation) {
  for (const double hertz : {0.5, 1.0, 10.0}) {
    TestWorld world({}, Vec3::Zero());
    const JointId joint = world.joints(world.add(sprung_wheel(hertz, 0.0)))[0];
    crossing_time(world, joint, 1);
    const double period = crossing_time(world, joint, 20) / 10.0;
    EXPECT_NEAR(period, 1.0 / hertz, 2e-3 / hertz) << hertz;
  }
}

TEST(Springs, WithADamperDecayAsTheEquationSays) {
  const double hertz = 1.0;
  const double ratio = 0.1;
  const double omega = 2.0 * M_PI * hertz;
  const double damped = omega * std::sqrt(1.0 - ratio * ratio);
  TestWorld world({}, Vec3::Zero());
  const JointId joint = world.joints(world.add(sprung_wheel(hertz, ratio)))[0];
  double worst = 0.0;
  for (int i = 1; i <= 3000; ++i) {
    world.run(kStep);
    const double t = i * kStep;
    const double exact = 0.5 * std::exp(-ratio * omega * t) *
                         (std::cos(damped * t) + ratio * omega / damped * std::sin(damped * t));
    worst = std::max(worst, std::abs(world.joint(joint).position - exact));
  }
  printf("sprung hinge with a damper: at most %.5f rad off\n", worst);
  EXPECT_LT(worst, 0.005 * 0.5);
}

TEST(Springs, HangAsFarAsTheirWeightPullsThem) {
  TestWorld world;
  desc::Model model = model_of("scale", {ghost_link("pan", 2.0, {0.2, 0.2, 0.02})});
  model.joints = {joint_of(Type::kPrismatic, "world", "pan")};
  model.joints[0].axes[0].spring_stiffness = 400.0;
  model.joints[0].axes[0].spring_reference = 0.1;
  model.joints[0].axes[0].damping = 60.0;
  const JointId joint = world.joints(world.add(model))[0];
  world.run(3.0);
  EXPECT_NEAR(world.joint(joint).position, 0.1 - 2.0 * 9.81 / 400.0, 1e-5);
  EXPECT_NEAR(world.joint(joint).effort, 2.0 * 9.81, 0.01);
  EXPECT_EQ(world.awake_count(), 0U);
}

TEST(Springs, OfAnyStiffnessAreStable) {
  TestWorld world;
  desc::Model model = model_of("scale", {ghost_link("pan", 2.0, {0.2, 0.2, 0.02})});
  model.joints = {joint_of(Type::kPrismatic, "world", "pan")};
  model.joints[0].axes[0].spring_stiffness = 1e9;
  model.joints[0].axes[0].initial_position = 0.01;
  const JointId joint = world.joints(world.add(model))[0];
  world.run(1.0);
  EXPECT_NEAR(world.joint(joint).position, 0.0, 1e-6);
}

TEST(Latch, HoldsAgainstAnyTorqueAlsoPastItsAxisEffort) {
  TestWorld world;
  desc::Model door = door_model("door");
  door.joints[1].axes[0].effort = 20.0;
  const ModelId id = world.add(door);
  const JointId hinge = world.joints(id)[1];
  const LinkId leaf = world.links(id)[1];
  world.latch(hinge, dInfinity);
  world.run(1.0);
  EXPECT_EQ(world.awake_count(), 0U);
  double most = 0.0;
  for (int i = 0; i < 1000; ++i) {
    world.push(leaf, {0, i < 500 ? -1e4 : 1e4, 0}, Vec3::Zero(), {0.75, 0, 1.0});
    world.run(kStep);
    most = std::max(most, std::abs(world.joint(hinge).position));
  }
  printf("a latch under 7500 N m gives way by %.2e rad\n", most);
  EXPECT_LT(most, 1e-4);
  world.unlatch(hinge);
  for (int i = 0; i < 500; ++i) {
    world.push(leaf, {0, -20.0, 0}, Vec3::Zero(), {0.75, 0, 1.0});
    world.run(kStep);
  }
  EXPECT_LT(world.joint(hinge).position, -0.1);
}

TEST(Latch, ThatCanBreakHoldsBelowItsTorqueOnly) {
  for (const double torque : {49.0, 51.0}) {
    TestWorld world;
    const ModelId id = world.add(door_model("door"));
    const JointId hinge = world.joints(id)[1];
    world.latch(hinge, 50.0);
    for (int i = 0; i < 500; ++i) {
      world.add_force(hinge, -torque);
      world.run(kStep);
    }
    const double moved = -world.joint(hinge).position;
    EXPECT_TRUE(torque < 50.0 ? std::abs(moved) < 1e-4 : moved > 0.01) << moved;
  }
}

}  // namespace
}  // namespace angen::physics::testing
