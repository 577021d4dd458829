#include "physics/joints.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models.h"

namespace angen::physics::testing {
namespace {

using Type = desc::Joint::Type;

/// Two rods of 1 m and 1 kg, hung on each other about y. Angles are those between them.
desc::Model double_pendulum(double first, double second) {
  const Vec3 rod(0.02, 0.02, 1.0);
  desc::Model model =
      model_of("pendulum", {ghost_link("upper", 1.0, rod, {{0, 0, -0.5}, Quat::Identity()}),
                            ghost_link("lower", 1.0, rod, {{0, 0, -1.5}, Quat::Identity()})});
  model.joints = {joint_of(Type::kRevolute, "world", "upper", Vec3::UnitY()),
                  joint_of(Type::kRevolute, "upper", "lower", Vec3::UnitY(), {0, 0, -1})};
  model.joints[0].axes[0].initial_position = first;
  model.joints[1].axes[0].initial_position = second;
  return model;
}

/// A wheel of 1/150 kg m^2, which is a box of 0.2 m, about z.
desc::Model wheel() {
  desc::Model model = model_of("wheel", {ghost_link("w", 1.0, {0.2, 0.2, 0.2})});
  model.joints = {joint_of(Type::kRevolute, "world", "w")};
  return model;
}

/// A cabin of 10 kg that slides along z.
desc::Model cabin() {
  desc::Model model = model_of("lift", {ghost_link("cabin", 10.0, {1, 1, 1})});
  model.joints = {joint_of(Type::kPrismatic, "world", "cabin")};
  return model;
}

/// Above that of hanging at rest, J.
double energy(const TestWorld& world, ModelId id) {
  double sum = 2.0 * 9.81 * 2.0 * 0.5;  // at rest 0.5 m and 1.5 m below the first hinge
  const double moment = (1.0 + 0.02 * 0.02) / 12.0;
  for (const LinkId link : world.links(id)) {
    const LinkState s = world.link(link);
    sum += 9.81 * s.pose.position.z() + 0.5 * s.linear_velocity.squaredNorm() +
           0.5 * moment * s.angular_velocity.squaredNorm();
  }
  return sum;
}

TEST(Joints, DoublePendulumKeepsItsEnergy) {
  for (const auto& [milliseconds, seconds] : {std::pair(1, 60), std::pair(5, 10)}) {
    desc::Physics settings;
    settings.step = milliseconds * 1'000'000;
    TestWorld world(settings);
    const ModelId id = world.add(double_pendulum(2.0, 1.0));
    const double start = energy(world, id);
    world.run(seconds);
    const double change = energy(world, id) / start - 1.0;
    printf("double pendulum at %d ms: %+.3f %% of its energy in %d s\n", milliseconds,
           100.0 * change, seconds);
    EXPECT_LT(std::abs(change), milliseconds == 1 ? 0.01 : 0.02);
  }
}

TEST(Joints, HingeThatMeetsItsStopRestsThere) {
  TestWorld world;
  const ModelId id = world.add(door_model("door"));
  const JointId hinge = world.joints(id)[1];
  for (int i = 0; i < 1500; ++i) {
    world.add_force(hinge, -20.0);
    world.run(kStep);
    ASSERT_GT(world.joint(hinge).position, -1.57 - 0.003);
  }
  EXPECT_NEAR(world.joint(hinge).position, -1.57, 1e-4);
  EXPECT_NEAR(world.joint(hinge).effort, 20.0, 0.01);
  world.run(2.0);
  EXPECT_FALSE(world.awake(world.links(id)[1]));
}

TEST(Joints, LinksThatAreFixedTogetherNeverPartTheirPoses) {
  TestWorld world;
  const ModelId id = world.add(door_model("door", {3, 4, 5}));
  const Pose before =
      world.link(world.links(id)[1]).pose.inverse() * world.link(world.links(id)[2]).pose;
  for (int i = 0; i < 500; ++i) {
    world.add_force(world.joints(id)[1], -30.0);
    world.run(kStep);
  }
  const Pose after =
      world.link(world.links(id)[1]).pose.inverse() * world.link(world.links(id)[2]).pose;
  EXPECT_LT((before.position - after.position).norm(), 1e-12);
  EXPECT_LT((before.rotation.coeffs() - after.rotation.coeffs()).norm(), 1e-12);
  EXPECT_GT(std::abs(world.joint(world.joints(id)[1]).position), 0.1);
}

TEST(Joints, BrakeHoldsALoadWithoutMotionAndSleeps) {
  TestWorld world;
  desc::Link arm = ghost_link("arm", 50.0 / 9.81, {0.1, 0.1, 0.1}, {{1, 0, 0}, Quat::Identity()});
  desc::Model model = model_of("crane", {arm});
  model.joints = {joint_of(Type::kRevolute, "world", "arm", Vec3::UnitY())};
  const ModelId id = world.add(model);
  const JointId joint = world.joints(id)[0];
  world.set_motor(joint, 0.0, 60.0);
  world.run(0.4);
  EXPECT_NEAR(world.joint(joint).effort, -50.0, 0.01);
  world.run(2.0);
  EXPECT_LT(std::abs(world.joint(joint).position), 1e-6);
  EXPECT_FALSE(world.awake(world.links(id)[0]));
  EXPECT_NEAR(world.joint(joint).effort, -50.0, 0.01);
  world.set_motor(joint, 0.0, 40.0);
  world.run(0.5);
  // 10 N m too little: it falls with 10 / (m r^2).
  EXPECT_GT(world.joint(joint).position, 0.1);
}

TEST(Joints, HoweverOftenTheyFallAsleepNothingAddsUp) {
  TestWorld world({}, Vec3::Zero());
  const ModelId door = world.add(door_model("door", {1, 2, 0}));
  const JointId hinge = world.joints(door)[1];
  const LinkId leaf = world.links(door)[1];
  world.set_motor(hinge, -0.5, 100.0);
  world.run(2.0);
  world.set_motor(hinge, 0.0, 100.0);
  world.run(1.0);
  ASSERT_FALSE(world.awake(leaf));
  const Pose before = world.link(leaf).pose;
  const double angle = world.joint(hinge).position;
  EXPECT_NEAR(angle, -1.0, 0.01);
  for (int i = 0; i < 100; ++i) {
    world.wake(leaf);
    world.run(0.6);
    ASSERT_FALSE(world.awake(leaf));
  }
  EXPECT_LT((world.link(leaf).pose.position - before.position).norm(), 1e-9);
  EXPECT_NEAR(world.joint(hinge).position, angle, 1e-9);
}

TEST(Joints, DampingIsThatOfTheEquation) {
  TestWorld world({}, Vec3::Zero());
  desc::Model model = wheel();
  const double inertia = 0.08 / 12.0;
  model.joints[0].axes[0].damping = 2.0 * inertia;
  const ModelId id = world.add(model);
  const JointId joint = world.joints(id)[0];
  world.add_force(joint, 10.0 * inertia / kStep);
  world.run(kStep);
  const double start = world.joint(joint).velocity;
  EXPECT_NEAR(start, 10.0, 0.03);
  world.run(1.0);
  // Implicit Euler: (1 + 2 h)^-1000.
  EXPECT_NEAR(world.joint(joint).velocity, start * std::pow(1.0 + 2.0 * kStep, -1000), 1e-4);
  EXPECT_NEAR(world.joint(joint).position, start * (1.0 - std::exp(-2.0)) / 2.0, 0.02);
}

TEST(Joints, DampingOfAnySizeIsStable) {
  TestWorld world({}, Vec3::Zero());
  desc::Model model = model_of("wheel", {ghost_link("w", 0.01, {0.02, 0.02, 0.02})});
  model.joints = {joint_of(Type::kRevolute, "world", "w")};
  model.joints[0].axes[0].damping = 100.0;
  const ModelId id = world.add(model);
  for (int i = 0; i < 100; ++i) {
    world.add_force(world.joints(id)[0], 1.0);
    world.run(kStep);
  }
  EXPECT_NEAR(world.joint(world.joints(id)[0]).velocity, 0.01, 1e-6);
}

TEST(Joints, FrictionHoldsBelowItsTorqueAndSlipsAbove) {
  TestWorld world({}, Vec3::Zero());
  desc::Model model = wheel();
  model.joints[0].axes[0].friction = 0.5;
  const ModelId id = world.add(model);
  const JointId joint = world.joints(id)[0];
  for (int i = 0; i < 100; ++i) {
    world.add_force(joint, 0.49);
    world.run(kStep);
  }
  EXPECT_LT(std::abs(world.joint(joint).position), 1e-6);
  for (int i = 0; i < 100; ++i) {
    world.add_force(joint, 0.6);
    world.run(kStep);
  }
  EXPECT_NEAR(world.joint(joint).velocity, 0.1 * 0.1 / (0.08 / 12.0), 1e-3);
}

TEST(Joints, MotorOfLimitedForceReachesItsSpeed) {
  TestWorld world({}, Vec3::Zero());
  const JointId joint = world.joints(world.add(cabin()))[0];
  world.set_motor(joint, 1.0, 20.0);
  world.run(0.25);
  EXPECT_NEAR(world.joint(joint).velocity, 0.5, 1e-6);
  EXPECT_NEAR(world.joint(joint).effort, 20.0, 1e-6);
  world.run(0.75);
  EXPECT_NEAR(world.joint(joint).velocity, 1.0, 1e-6);
  EXPECT_NEAR(world.joint(joint).position, 0.75, 0.005);
}

TEST(Joints, InitialPositionTakesDescendantsAlong) {
  TestWorld world({}, Vec3::Zero());
  desc::Model model =
      model_of("arm",
               {ghost_link("upper", 1.0, {0.1, 0.1, 0.1}, {{1, 0, 0}, Quat::Identity()}),
                ghost_link("lower", 1.0, {0.1, 0.1, 0.1}, {{2, 0, 0}, Quat::Identity()})},
               {{0, 0, 7}, Quat::Identity()});
  model.joints = {joint_of(Type::kRevolute, "upper", "lower", Vec3::UnitZ(), {1.5, 0, 0}),
                  joint_of(Type::kRevolute, "world", "upper")};
  model.joints[0].axes[0].initial_position = M_PI / 2;
  model.joints[1].axes[0].initial_position = M_PI / 2;
  const ModelId id = world.add(model);
  EXPECT_NEAR((world.link(world.links(id)[0]).pose.position - Vec3(0, 1, 7)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((world.link(world.links(id)[1]).pose.position - Vec3(-0.5, 1.5, 7)).norm(), 0.0,
              1e-12);
  EXPECT_NEAR(world.joint(world.joints(id)[0]).position, M_PI / 2, 1e-9);
  EXPECT_NEAR(world.joint(world.joints(id)[1]).position, M_PI / 2, 1e-9);
  world.run(1.0);
  EXPECT_NEAR((world.link(world.links(id)[1]).pose.position - Vec3(-0.5, 1.5, 7)).norm(), 0.0,
              1e-9);
}

/// Position and velocity have one sign, whoever of parent and child is static or moves.
class JointSigns : public ::testing::TestWithParam<std::tuple<Type, int>> {};

TEST_P(JointSigns, ForceMotorPositionAndEffortAgree) {
  const auto [type, arrangement] = GetParam();
  TestWorld world({}, Vec3::Zero());
  desc::Model model =
      model_of("m", {ghost_link("a", 1.0, {0.2, 0.2, 0.2}), ghost_link("b", 1.0, {0.2, 0.2, 0.2})});
  const Vec3 axis = Vec3(1, 2, 3).normalized();
  model.joints = {joint_of(type, "a", "b", axis)};
  if (arrangement == 0) model.joints.push_back(joint_of(Type::kFixed, "world", "a"));
  if (arrangement == 1) model.joints.push_back(joint_of(Type::kFixed, "world", "b"));
  const ModelId id = world.add(model);
  const JointId joint = world.joints(id)[0];
  for (int i = 0; i < 10; ++i) {
    world.add_force(joint, 0.1);
    world.run(kStep);
  }
  EXPECT_GT(world.joint(joint).velocity, 0.0);
  EXPECT_GT(world.joint(joint).position, 0.0);
  const LinkState a = world.link(world.links(id)[0]);
  const LinkState b = world.link(world.links(id)[1]);
  const Vec3 apart = type == Type::kRevolute ? Vec3(b.angular_velocity - a.angular_velocity)
                                             : Vec3(b.linear_velocity - a.linear_velocity);
  EXPECT_NEAR(apart.dot(axis), world.joint(joint).velocity, 1e-9);
  world.set_motor(joint, 0.5, 1.0);
  world.run(kStep);
  EXPECT_GT(world.joint(joint).effort, 0.0);
  world.run(1.0);
  EXPECT_NEAR(world.joint(joint).velocity, 0.5, 1e-6);
  const double before = world.joint(joint).position;
  world.run(1.0);
  EXPECT_NEAR(world.joint(joint).position - before, 0.5, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(All, JointSigns,
                         ::testing::Combine(::testing::Values(Type::kRevolute, Type::kPrismatic),
                                            ::testing::Values(0, 1, 2)));

TEST(Joints, OnlyAForceThatIsOneWakesASleepingBody) {
  TestWorld world;
  const ModelId id = world.add(door_model("door"));
  const JointId hinge = world.joints(id)[1];
  const LinkId leaf = world.links(id)[1];
  world.run(1.0);
  ASSERT_FALSE(world.awake(leaf));
  const Pose before = world.link(leaf).pose;
  for (const double nothing : {0.0, std::nan(""), HUGE_VAL}) {
    world.add_force(hinge, nothing);
    world.run(0.1);
    EXPECT_FALSE(world.awake(leaf));
    EXPECT_EQ(world.link(leaf).pose, before);
  }
  world.add_force(hinge, -5.0);
  EXPECT_TRUE(world.awake(leaf));
  world.run(1e-3);
  const double first_step = world.joint(hinge).velocity;
  EXPECT_LT(first_step, 0.0);
  EXPECT_GT(first_step, -5.0 * 1e-3 / 5.0) << "torques of the time asleep must not add up";
}

TEST(Joints, ForcesAndMotorsKeepTheLimitsOfTheirAxis) {
  TestWorld world({}, Vec3::Zero());
  desc::Model model = cabin();
  model.joints[0].axes[0].effort = 50.0;
  model.joints[0].axes[0].velocity = 0.8;
  const ModelId id = world.add(model);
  const JointId joint = world.joints(id)[0];
  world.add_force(joint, 1000.0);
  world.run(kStep);
  EXPECT_NEAR(world.joint(joint).velocity, 5.0 * kStep, 1e-9);
  for (int i = 0; i < 1000; ++i) {
    world.add_force(joint, 1000.0);
    world.run(kStep);
  }
  EXPECT_NEAR(world.joint(joint).velocity, 0.8, 0.006);
  world.set_motor(joint, -3.0, 1000.0);
  world.run(kStep);
  EXPECT_NEAR(world.joint(joint).effort, -50.0, 1e-6);
  world.run(1.0);
  EXPECT_NEAR(world.joint(joint).velocity, -0.8, 1e-6);
}

// A load of 2 kg, held 0.3 m in front of the joint.
TEST(Joints, AWrenchIsWhatTheChildGivesItsParent) {
  TestWorld world;
  desc::Model arm = model_of(
      "arm", {ghost_link("base", 1.0, {0.1, 0.1, 0.1}),
              ghost_link("load", 2.0, {0.1, 0.1, 0.1}, {{0.3, 0.0, 0.0}, Quat::Identity()})});
  arm.joints = {joint_of(Type::kFixed, "world", "base"),
                joint_of(Type::kRevolute, "base", "load", Vec3::UnitY())};
  arm.joints[1].axes[0].lower = arm.joints[1].axes[0].upper = 0.0;
  const JointId joint = world.joints(world.add(arm)).at(1);
  world.run(0.4);
  const auto expect_load = [&] {
    const Wrench wrench = world.wrench(joint);
    EXPECT_LT((wrench.force - Vec3(0.0, 0.0, -2.0 * 9.81)).norm(), 0.02) << wrench.force;
    EXPECT_LT((wrench.torque - Vec3(0.0, 0.3 * 2.0 * 9.81, 0.0)).norm(), 0.02) << wrench.torque;
  };
  expect_load();
  world.run(2.0);  // asleep
  EXPECT_EQ(world.awake_count(), 0U);
  expect_load();
}

TEST(Joints, AWrenchHoldsWhatIsAppliedToTheJoint) {
  TestWorld world({}, Vec3::Zero());
  desc::Model arm = model_of("arm", {ghost_link("bob", 1.0, {0.1, 0.1, 0.1})});
  arm.joints = {joint_of(Type::kRevolute, "world", "bob", Vec3::UnitZ())};
  const JointId joint = world.joints(world.add(arm)).at(0);
  world.add_force(joint, 0.5);
  world.run(0.001);
  EXPECT_NEAR(world.wrench(joint).torque.z(), -0.5, 1e-9);
  world.run(0.001);
  EXPECT_NEAR(world.wrench(joint).torque.z(), 0.0, 1e-9);
}

}  // namespace
}  // namespace angen::physics::testing
