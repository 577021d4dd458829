#include <gtest/gtest.h>

#include "robot.h"

namespace angen::physics::testing {
namespace {

TEST(Drive, PersonWalksAtItsSpeedAndPushesAWallWithAtMostItsForce) {
  TestWorld world;
  world.add(floor_model());
  world.add(static_box("wall", {0.1, 4, 2}, {2.0, 0, 1}));
  const LinkId body = world.only_link(world.add(person_model("person", {0, 0, 0.001})));
  world.drive(body, {1.0, 0, 0}, 0.0, 150.0);
  world.run(1.0);
  EXPECT_NEAR(world.link(body).linear_velocity.x(), 1.0, 1e-3);
  world.run(2.0);
  double most = 0.0;
  for (int i = 0; i < 500; ++i) {
    world.run(kStep);
    most = std::max(most, std::abs(force_on(world, "wall::link::collision").x()));
    ASSERT_LT(world.link(body).pose.position.x(), 1.95 - 0.25 + 1e-3);
  }
  EXPECT_LE(most, 150.0);
  EXPECT_GT(most, 130.0);
  EXPECT_TRUE(world.awake(body)) << "one that wants to go on must not fall asleep";
  EXPECT_EQ(world.failed_steps(), 0U);
}

TEST(Drive, LongStepsWalkAsFarAsShortOnes) {
  TestWorld one, twenty;
  std::vector<LinkState> ends;
  for (TestWorld* world : {&one, &twenty}) {
    world->add(floor_model());
    const LinkId body = world->only_link(world->add(person_model("person", {0, 0, 0.001})));
    world->run(0.1);
    ASSERT_EQ(world->longest_step(20), 20);
    for (const double speed : {1.0, -0.5, 0.0}) {
      world->drive(body, {speed, 0.3 * speed, 0}, 0.0, 150.0);
      for (int i = 0; i < 50; ++i) {
        if (world == &one) world->run(20 * kStep);
        if (world == &twenty) world->step(100 + 20 * i, 20);
      }
    }
    ends.push_back(world->link(body));
  }
  EXPECT_GT(ends[0].pose.position.x(), 0.2);
  EXPECT_LT((ends[1].pose.position - ends[0].pose.position).norm(), 1e-3);
  EXPECT_LT((ends[1].linear_velocity - ends[0].linear_velocity).norm(), 1e-3);
}

TEST(Drive, WhoTouchesAWallOrAThingDoesMoreThanWalk) {
  TestWorld world;
  world.add(floor_model());
  world.add(static_box("wall", {0.1, 4, 2}, {1.0, 0, 1}));
  const LinkId body = world.only_link(world.add(person_model("person", {0, 0, 0.001})));
  world.drive(body, {1.0, 0, 0}, 0.0, 150.0);
  world.run(0.5);
  EXPECT_EQ(world.longest_step(20), 20);
  world.run(1.5);
  EXPECT_EQ(world.longest_step(20), 1);
  world.drive(body, {0, 0, 0}, 0.0, 150.0);
  world.run(0.1);
  EXPECT_TRUE(world.awake(body));
  EXPECT_EQ(world.longest_step(20), 20) << "it rests at the wall";
}

TEST(Drive, WhatCameToRestAllowsLongSteps) {
  TestWorld world;
  world.add(floor_model());
  world.only_link(world.add(person_model("person", {0, 0, 0.001})));
  const LinkId box =
      world.only_link(world.add(box_model("box", 20.0, {0.4, 0.4, 0.4}, {2, 0, 0.2})));
  world.run(0.1);
  EXPECT_TRUE(world.awake(box));
  EXPECT_EQ(world.longest_step(20), 20);
  const Vec3 at = world.link(box).pose.position;
  for (int i = 0; i < 10; ++i) world.step(100 + 20 * i, 20);
  EXPECT_LT((world.link(box).pose.position - at).norm(), 1e-4);
  world.push(box, {2000, 0, 0}, Vec3::Zero(), at);
  world.run(0.01);
  EXPECT_EQ(world.longest_step(20), 1);
}

TEST(Drive, ALeafThatIsLedAllowsLongStepsUntilItTouchesSomething) {
  for (const double longest : {0.0, 0.0155}) {
    TestWorld world;
    desc::Model door = door_model("door");
    door.joints[1].longest_step = longest;
    const ModelId id = world.add(door);
    world.add(static_box("wall", {0.1, 0.1, 2}, {0.0, -0.6, 1}));
    const JointId hinge = world.joints(id).at(1);
    world.set_motor(hinge, -0.5, 100.0);
    world.run(0.1);
    EXPECT_EQ(world.longest_step(20), longest > 0.0 ? 15 : 1);
    EXPECT_EQ(world.longest_step(10), longest > 0.0 ? 10 : 1);
    const double from = world.joint(hinge).position;
    for (int i = 0; i < 60; ++i) world.step(100 + 15 * i, 15);
    EXPECT_NEAR(world.joint(hinge).position, from - 0.5 * 60 * 0.015, 1e-3);
    world.run(3.0);
    EXPECT_GT(world.joint(hinge).position, -1.5);
    EXPECT_EQ(world.longest_step(20), 1);
  }
}

TEST(Drive, ForceIsLimitedInEachDirection) {
  TestWorld world({}, Vec3::Zero());
  const LinkId body = world.only_link(world.add(person_model("person", Vec3::Zero())));
  for (int i = 0; i < 36; ++i) {
    const Vec3 before = world.link(body).linear_velocity;
    const double a = i * M_PI / 18;
    world.drive(body, Vec3(std::cos(a), std::sin(a), 0) * 100.0, 0.0, 150.0);
    world.run(kStep);
    const double force = (world.link(body).linear_velocity - before).norm() * 70.0 / kStep;
    EXPECT_LE(force, 150.0 * (1 + 1e-6));
    EXPECT_GE(force, 140.0);
  }
}

TEST(Drive, PersonTurnsAndNeverTilts) {
  TestWorld world;
  world.add(floor_model());
  world.add(static_box("step", {0.3, 4, 0.3}, {1.0, 0, 0.15}));
  const LinkId body = world.only_link(world.add(person_model("person", {0, 0.1, 0.001})));
  world.drive(body, {1.0, 0, 0}, 0.5, 150.0);
  world.run(5.0);
  const Pose pose = world.link(body).pose;
  EXPECT_NEAR((pose.rotation * Vec3::UnitZ() - Vec3::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(yaw_of(pose.rotation), 2.5, 0.02);
}

TEST(Drive, StandingPersonSleepsAndIsPushedByNobody) {
  TestWorld world;
  world.add(floor_model());
  const LinkId body = world.only_link(world.add(person_model("person", {0, 0, 0.001})));
  world.drive(body, Vec3::Zero(), 0.0, 150.0);
  world.run(2.0);
  EXPECT_FALSE(world.awake(body));
  const Vec3 before = world.link(body).pose.position;
  world.drive(body, Vec3::Zero(), 0.0, 150.0);
  EXPECT_FALSE(world.awake(body)) << "the same command again is no change";
  world.run(1.0);
  EXPECT_EQ(world.link(body).pose.position, before);
  world.drive(body, {0, 1, 0}, 0.0, 150.0);
  world.run(1.0);
  EXPECT_NEAR(world.link(body).pose.position.y() - before.y(), 0.77, 0.02);
}

TEST(Robot, RidesALiftAndKeepsItsPlace) {
  TestWorld world;
  const ModelId lift = world.add(lift_model("lift"));
  const ModelId robot = world.add(robot_model("robot", {0.1, 0.2, 0.0}));
  const JointId joint = world.joints(lift)[0];
  for (const JointId wheel : world.joints(robot)) world.set_motor(wheel, 0.0, 1.0);
  world.set_motor(joint, 0.0, 1000.0);
  world.run(1.0);
  const Vec3 before = world.link(world.links(robot)[0]).pose.position;
  EXPECT_EQ(world.awake_count(), 0U);
  world.set_motor(joint, 0.5, 1000.0);
  world.run(6.0);
  world.set_motor(joint, 0.0, 1000.0);
  world.run(1.0);
  EXPECT_EQ(world.awake_count(), 0U);
  const Vec3 after = world.link(world.links(robot)[0]).pose.position;
  EXPECT_NEAR(world.joint(joint).position, 3.0, 2e-3);
  EXPECT_NEAR(after.z() - before.z(), world.joint(joint).position, 1e-3);
  EXPECT_LT((after - before).head<2>().norm(), 1e-3);
  EXPECT_NEAR(world.joint(joint).effort, 14.2 * 9.81, 1.0);
  EXPECT_EQ(world.failed_steps(), 0U);
}

TEST(Robot, DrivesOnALiftFloorToo) {
  TestWorld world;
  const ModelId lift = world.add(lift_model("lift"));
  world.set_motor(world.joints(lift)[0], 0.0, 1000.0);
  const ModelId robot = world.add(robot_model("robot", {-0.2, 0, 0}));
  world.run(0.2);
  for (const JointId wheel : world.joints(robot)) world.set_motor(wheel, 0.2 / 0.035, 1.0);
  world.run(2.0);
  EXPECT_NEAR(world.link(world.links(robot)[0]).pose.position.x(), 0.2, 0.02);
}

TEST(Door, FreeSwingLosesEnergyOnlyByDamping) {
  TestWorld world;
  desc::Model model = door_model("door");
  model.joints[1].axes[0].lower = -1e16;
  model.joints[1].axes[0].upper = 1e16;
  const ModelId free_door = world.add(model);
  model.name = "damped";
  model.pose.position.x() = 5.0;
  model.joints[1].axes[0].damping = 2.0;
  const ModelId damped = world.add(model);
  for (const ModelId id : {free_door, damped}) world.add_force(world.joints(id)[1], 9000.0);
  world.run(kStep);
  const double start = world.joint(world.joints(free_door)[1]).velocity;
  EXPECT_GT(start, 0.5);
  world.run(3.0);
  EXPECT_NEAR(world.joint(world.joints(free_door)[1]).velocity, start, 1e-3 * start);
  // Moment about the hinge: leaf, handles and strip.
  const double moment =
      40.0 * (0.64 / 3.0 + 0.04 * 0.04 / 12.0) + 2 * 0.2 * 0.75 * 0.75 + 0.1 * 0.49;
  EXPECT_NEAR(world.joint(world.joints(damped)[1]).velocity, start * std::exp(-2.0 * 3.0 / moment),
              0.01 * start);
}

TEST(Drive, TheExactSolverHardlyEverFailsAtPeopleWhoPressOnEachOther) {
  TestWorld world;
  world.add(floor_model());
  constexpr int kPeople = 5;
  std::vector<LinkId> bodies;
  for (int i = 0; i < kPeople; ++i) {
    const double angle = 2.0 * M_PI * i / kPeople;
    const Vec3 at(std::cos(angle), std::sin(angle), 0.001);
    bodies.push_back(world.only_link(world.add(person_model("person" + std::to_string(i), at))));
  }
  for (int step = 0; step < 3000; ++step) {
    for (const LinkId body : bodies) {
      const Vec3 way = -world.link(body).pose.position;
      world.drive(body, way.norm() > 0.8 ? Vec3(0.8 * way.normalized()) : way, 0.0, 150.0);
    }
    world.run(kStep);
  }
  EXPECT_LT(world.failed_steps(), 10U);
  for (const LinkId body : bodies) {
    const double from_middle = world.link(body).pose.position.head<2>().norm();
    EXPECT_GT(from_middle, 0.40);  // five circles of 0.25 m about a point
    EXPECT_LT(from_middle, 0.45);
  }
}

}  // namespace
}  // namespace angen::physics::testing
