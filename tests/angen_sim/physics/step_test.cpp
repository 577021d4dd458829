#include <gtest/gtest.h>

#include "models.h"

namespace angen::physics::testing {
namespace {

TEST(Step, FallAsTheSemiImplicitEulerSumSays) {
  TestWorld world;
  const LinkId link = world.only_link(world.add(box_model("box", 2.0, {0.1, 0.2, 0.3}, {0, 0, 9})));
  world.run(1.0);
  const int n = 1000;
  const double exact = 9.0 - 9.81 * kStep * kStep * n * (n + 1) / 2.0;
  EXPECT_NEAR(world.link(link).pose.position.z(), exact, 1e-9);
  EXPECT_NEAR(world.link(link).pose.position.z(), 9.0 - 0.5 * 9.81, 9.81 * kStep);
  EXPECT_NEAR(world.link(link).linear_velocity.z(), -9.81, 1e-9);
}

TEST(Step, TurnAboutTheirCentreOfMassNotTheirOrigin) {
  TestWorld world({}, Vec3::Zero());
  desc::Model model = box_model("box", 2.0, {0.1, 0.1, 0.1});
  model.links[0].inertial.pose.position = {0.5, 0.0, 0.0};
  model.links.push_back(
      ghost_link("hub", 1.0, {0.1, 0.1, 0.1}, {{0.5, 0.0, 0.0}, Quat::Identity()}));
  model.joints.push_back(
      joint_of(desc::Joint::Type::kRevolute, "hub", "link", Vec3::UnitZ(), {0.5, 0.0, 0.0}));
  const ModelId id = world.add(model);
  for (int i = 0; i < 500; ++i) {
    world.add_force(world.joints(id)[0], 0.01);
    world.step(i);
  }
  // The center stays, the origin circles it.
  const LinkState state = world.link(world.links(id)[0]);
  EXPECT_NEAR((state.pose * Vec3(0.5, 0, 0) - Vec3(0.5, 0, 0)).norm(), 0.0, 1e-6);
  const double inertia = 2.0 / 12.0 * 0.02;
  EXPECT_NEAR(state.angular_velocity.z(), 0.01 * 0.5 / inertia, 1e-6);
  EXPECT_NEAR(state.linear_velocity.norm(), 0.5 * state.angular_velocity.z(), 1e-6);
}

TEST(Step, WithoutGravityStay) {
  TestWorld world;
  desc::Model model = box_model("box", 2.0, {0.1, 0.1, 0.1});
  model.links[0].gravity = false;
  const LinkId link = world.only_link(world.add(model));
  world.run(1.0);
  EXPECT_EQ(world.link(link).pose.position, Vec3::Zero());
}

TEST(Step, ThatAreHalfWeightlessFallWithHalfTheAcceleration) {
  TestWorld world;
  desc::Model model = model_of(
      "pair", {ghost_link("a", 1.0, {0.1, 0.1, 0.1}), ghost_link("b", 1.0, {0.1, 0.1, 0.1})});
  model.links[1].gravity = false;
  model.joints = {joint_of(desc::Joint::Type::kFixed, "a", "b")};
  const ModelId id = world.add(model);
  world.run(1.0);
  EXPECT_NEAR(world.link(world.links(id)[1]).linear_velocity.z(), -9.81 / 2, 1e-9);
}

}  // namespace
}  // namespace angen::physics::testing
