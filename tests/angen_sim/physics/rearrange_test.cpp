#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnostics.h"
#include "robot.h"

namespace angen::physics::testing {
namespace {

class Rearrange : public ::testing::Test {
 protected:
  void run(int steps) {
    for (int i = 0; i < steps; ++i) world_.step(tick_++);
  }
  Pose pose(ModelId model, std::size_t link = 0) const {
    return world_.link(world_.links(model)[link]).pose;
  }

  desc::Physics settings_;
  World world_{settings_, kGravity, 1};
  std::int64_t tick_ = 0;
};

/// Two boxes in a row on the x axis, 1 m apart, the second on a hinge about z at the first.
desc::Model arm(const Vec3& at) {
  desc::Model model =
      model_of("arm", {ghost_link("base", 5.0, {0.2, 0.2, 0.2}),
                       ghost_link("link", 1.0, {0.2, 0.2, 0.2}, {{1, 0, 0}, Quat::Identity()})});
  model.pose.position = at;
  model.joints.push_back(
      joint_of(desc::Joint::Type::kRevolute, "base", "link", Vec3::UnitZ(), Vec3::Zero()));
  for (desc::Link& link : model.links) link.gravity = false;
  return model;
}

TEST_F(Rearrange, AMovedModelKeepsItsJointsAndIsAtRest) {
  const ModelId id = world_.add(arm({0, 0, 1}));
  world_.arrange(id, {0.7});
  const Pose link = pose(id, 1);
  const Pose by{{3, -2, 0.5}, from_rpy(0.1, -0.4, 2.0)};
  world_.set_velocity(world_.links(id)[0], {1, 0, 0}, Vec3::Zero());
  world_.move(id, by);
  EXPECT_NEAR(world_.joint(world_.joints(id)[0]).position, 0.7, 1e-12);
  EXPECT_LT((pose(id, 1).position - (by * link).position).norm(), 1e-12);
  EXPECT_EQ(world_.link(world_.links(id)[0]).linear_velocity, Vec3::Zero());
  run(10);
  EXPECT_LT((pose(id, 1).position - (by * link).position).norm(), 1e-9);
  EXPECT_NEAR(world_.joint(world_.joints(id)[0]).position, 0.7, 1e-9);
}

TEST_F(Rearrange, AMovedModelLeavesWhatItCarriedToFall) {
  const ModelId table = world_.add(static_box("table", {1, 1, 0.1}, {0, 0, 0.95}));
  const ModelId box = world_.add(box_model("box", 1.0, {0.2, 0.2, 0.2}, {0, 0, 1.1}));
  run(1500);
  ASSERT_FALSE(world_.awake(world_.links(box)[0]));
  world_.move(table, {{5, 0, 0}, Quat::Identity()});
  run(200);
  EXPECT_NEAR(pose(box).position.z(), 1.1 - 0.5 * 9.81 * 0.2 * 0.2, 0.002);
  EXPECT_EQ(pose(table).position.x(), 5.0);
}

TEST_F(Rearrange, AVelocityIsThatOfTheLinksOrigin) {
  desc::Model model = box_model("box", 2.0, {0.2, 0.2, 0.2}, {0, 0, 5});
  model.links[0].inertial.pose.position = {0.3, 0, 0};
  model.links[0].gravity = false;
  const ModelId id = world_.add(model);
  const LinkId link = world_.links(id)[0];
  world_.set_velocity(link, {0.1, 0.2, 0}, {0, 0, 2});
  const LinkState state = world_.link(link);
  EXPECT_LT((state.linear_velocity - Vec3(0.1, 0.2, 0)).norm(), 1e-12);
  EXPECT_LT((state.angular_velocity - Vec3(0, 0, 2)).norm(), 1e-12);
  // A free body turns about its center of mass, which keeps its speed of v + w x r.
  run(1000);
  const Vec3 center = world_.link(link).pose * Vec3(0.3, 0, 0);
  EXPECT_LT((center - (Vec3(0.3, 0, 5) + Vec3(0.1, 0.8, 0))).norm(), 1e-3);
}

TEST_F(Rearrange, WhatHangsOnAJointMovesWithItsPosition) {
  const ModelId id = world_.add(arm({0, 0, 1}));
  world_.arrange(id, {M_PI / 2});
  EXPECT_LT((pose(id, 1).position - Vec3(0, 1, 1)).norm(), 1e-12);
  EXPECT_LT((pose(id, 0).position - Vec3(0, 0, 1)).norm(), 1e-12);
  world_.arrange(id, {-3 * M_PI});  // turns are counted
  EXPECT_NEAR(world_.joint(world_.joints(id)[0]).position, -3 * M_PI, 1e-9);
  EXPECT_LT((pose(id, 1).position - Vec3(-1, 0, 1)).norm(), 1e-12);
  world_.arrange(id, {std::nullopt});
  EXPECT_NEAR(world_.joint(world_.joints(id)[0]).position, -3 * M_PI, 1e-9);
}

TEST_F(Rearrange, AJointsPositionIsClampedToItsLimitsAndWhatMovesGoesOn) {
  desc::Model model = arm({0, 0, 1});
  model.joints[0].axes[0].upper = 0.5;
  const ModelId id = world_.add(model);
  world_.set_velocity(world_.links(id)[0], {0, 0, 0.5}, Vec3::Zero());
  world_.arrange(id, {2.0});
  EXPECT_NEAR(world_.joint(world_.joints(id)[0]).position, 0.5, 1e-12);
  EXPECT_NEAR(world_.joint(world_.joints(id)[0]).velocity, 0.0, 1e-12);
  EXPECT_LT((world_.link(world_.links(id)[0]).linear_velocity - Vec3(0, 0, 0.5)).norm(), 1e-12);
  EXPECT_LT((world_.link(world_.links(id)[1]).linear_velocity - Vec3(0, 0, 0.5)).norm(), 1e-12);
}

TEST_F(Rearrange, ALinkThatAJointHoldsToTheWorldStays) {
  const ModelId door = world_.add(door_model("door"));
  const Pose before = pose(door, 1);
  EXPECT_THROW(world_.move(world_.links(door)[1], {{1, 0, 0}, Quat::Identity()}), Error);
  EXPECT_THROW(world_.move(door, {{1e9, 0, 0}, Quat::Identity()}), Error);
  EXPECT_EQ(pose(door, 1), before);
}

TEST_F(Rearrange, AnotherMassFollowsNewton) {
  desc::Model model = box_model("box", 1.0, {0.2, 0.2, 0.2}, {0, 0, 5});
  model.links[0].gravity = false;
  const ModelId id = world_.add(model);
  const LinkId link = world_.links(id)[0];
  world_.set_velocity(link, {0.5, 0, 0}, Vec3::Zero());
  model.links[0].inertial.mass = 4.0;
  model.links[0].inertial.pose.position = {0.05, 0, 0};
  world_.redescribe(id, model);
  EXPECT_EQ(world_.mass(link), 4.0);
  EXPECT_LT((world_.link(link).pose.position - Vec3(0, 0, 5)).norm(), 1e-12);
  EXPECT_LT((world_.link(link).linear_velocity - Vec3(0.5, 0, 0)).norm(), 1e-12);
  for (int i = 0; i < 500; ++i) {
    world_.push(link, {8, 0, 0}, Vec3::Zero(), world_.link(link).pose * Vec3(0.05, 0, 0));
    run(1);
  }
  EXPECT_NEAR(world_.link(link).linear_velocity.x(), 0.5 + 8.0 / 4.0 * 0.5, 1e-9);
}

TEST_F(Rearrange, WhatCannotBeDescribedChangesNothing) {
  desc::Model model = box_model("box", 1.0, {0.2, 0.2, 0.2}, {0, 0, 5});
  const ModelId id = world_.add(model);
  model.links[0].inertial.moment.setZero();
  EXPECT_THROW(world_.redescribe(id, model), Error);
  EXPECT_EQ(world_.mass(world_.links(id)[0]), 1.0);
}

TEST_F(Rearrange, AnotherGravityWakesWhatSleeps) {
  world_.add(floor_model());
  const ModelId id = world_.add(box_model("box", 1.0, {0.2, 0.2, 0.2}, {0, 0, 0.1}));
  run(1500);
  ASSERT_EQ(world_.awake_count(), 0U);
  world_.set(settings_, {0, 0, 2.0});
  run(1000);
  EXPECT_NEAR(pose(id).position.z(), 0.1 + 0.5 * 2.0, 0.003);
  EXPECT_NEAR(world_.link(world_.links(id)[0]).linear_velocity.z(), 2.0, 1e-6 + 2 * kStep);
}

}  // namespace
}  // namespace angen::physics::testing
