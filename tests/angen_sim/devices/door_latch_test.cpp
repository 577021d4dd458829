// A door's latch: its force, its release, and its break.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "angen_sim/devices/doors.h"

namespace angen::test {
namespace {

TEST(Door, TheLatchHoldsAgainstAPushThatTheBrakeWouldNot) {
  Bench bench;
  Rig& door = add_door(bench);
  bench.run(0.5);
  const physics::JointId hinge = bench.world.joints(door.id())[1];
  bench.run(5.0, [&] { bench.world.add_force(hinge, -150.0); });
  EXPECT_NEAR(angle(door), 0.0, 0.001);
  EXPECT_EQ(door.mode(), "CLOSED");
}

/// A person of 70 kg who walks towards -y, against a leaf that opens that way.
void walk_against(Bench& bench, double speed, double seconds) {
  const physics::ModelId id = bench.add(person({0.6, 1.0, 0.001}));
  const physics::LinkId body = bench.world.links(id)[0];
  bench.run(seconds, [&] { bench.world.drive(body, {0, -speed, 0}, 0.0, 150.0); });
  bench.world.drive(body, Vec3::Zero(), 0.0, 150.0);
}

TEST(Door, TheLatchHoldsWhoeverWalksAgainstIt) {
  for (const double speed : {0.2, 0.7, 2.0}) {
    Bench bench;
    bench.add(ground());
    Rig& door = add_door(bench);
    bench.run(0.2);
    double most = 0.0;
    const physics::ModelId id = bench.add(person({0.6, 1.0, 0.001}));
    const physics::LinkId body = bench.world.links(id)[0];
    bench.run(1.0 / speed + 3.0, [&] {
      bench.world.drive(body, {0, -speed, 0}, 0.0, 150.0);
      most = std::max(most, std::abs(angle(door)));
    });
    printf("a person at %.1f m/s moves a latched leaf by %.2e rad\n", speed, most);
    EXPECT_LT(most, 1e-3) << speed;
    EXPECT_GT(bench.world.link(body).pose.position.y(), 0.0) << speed;
    EXPECT_EQ(door.mode(), "CLOSED");
  }
}

TEST(Door, TheLatchHoldsAThrownCrate) {
  Bench bench;
  Rig& door = add_door(bench);
  bench.run(0.2);
  desc::Model crate = box("crate", {0.8, 1.0, 1.0}, {0.3, 0.3, 0.3}, 20.0);
  crate.links[0].gravity = false;
  const physics::ModelId id = bench.add(crate);
  const physics::LinkId body = bench.world.links(id)[0];
  bench.world.push(body, {0, -20.0 * 8.0 / 1e-3, 0}, Vec3::Zero(), {0.8, 1.0, 1.0});
  double most = 0.0;
  bench.run(2.0, [&] { most = std::max(most, std::abs(angle(door))); });
  printf("a crate of 20 kg at 8 m/s moves a latched leaf by %.2e rad\n", most);
  EXPECT_LT(most, 1e-3);
}

TEST(Door, AHandOnItsHandleLetsItBePushedOpenUntilItIsLetGo) {
  for (const bool let_go : {false, true}) {
    Bench bench;
    bench.add(ground());
    Rig& door = add_door(bench);
    bench.run(0.2);
    ASSERT_TRUE(door.command("Unlatch").accepted);
    if (let_go) bench.run(3.1);
    walk_against(bench, 0.7, 3.0);
    EXPECT_GT(door.count("unlatched"), 0);
    EXPECT_EQ(angle(door) < -0.5, !let_go);
    EXPECT_EQ(std::abs(angle(door)) < 1e-3, let_go);
    EXPECT_EQ(door.mode(), let_go ? "CLOSED" : "AJAR");
  }
}

TEST(Door, LatchesWhereItIsThrownShut) {
  Bench bench;
  DoorMeasures measures;
  measures.angle = -1.0;
  Rig& door = add_door(bench, measures);
  bench.run(0.2);
  ASSERT_EQ(door.mode(), "AJAR");
  const physics::JointId hinge = bench.world.joints(door.id())[1];
  bench.run(0.25, [&] { bench.world.add_force(hinge, 100.0); });
  EXPECT_GT(door.at("hinge").velocity, 1.0);
  bench.run_until(2.0, [&] { return angle(door) > -0.01; });
  double most = 0.0;
  bench.run(2.0, [&] {
    bench.world.add_force(hinge, -100.0);
    most = std::max(most, -angle(door));
  });
  EXPECT_LT(most, 0.011);
  EXPECT_EQ(door.mode(), "CLOSED");
  ASSERT_TRUE(door.command("Open").accepted);
  bench.run(4.0);
  EXPECT_EQ(door.mode(), "OPEN");
}

// 10 N m: the magnet of a fridge; the brake of its drive would hold twice as much.
TEST(Door, ALatchThatCanBreakDoesSoAtItsTorque) {
  struct Case {
    double holds, torque, seconds, opens;  // N m, N m, s, rad
  };
  for (const Case& c :
       {Case{50, 45, 2, 0.1}, {50, 55, 2, 0.1}, {10, 8, 3, 0.3}, {10, 13, 3, 0.3}}) {
    Bench bench;
    Rig& door = add_door(bench, {}, {{"latch_torque", std::to_string(c.holds)}});
    bench.run(0.2);
    const physics::JointId hinge = bench.world.joints(door.id())[1];
    bench.run(c.seconds, [&] { bench.world.add_force(hinge, -c.torque); });
    printf("a latch of %.0f N m under %.0f N m: %.3f rad\n", c.holds, c.torque, angle(door));
    EXPECT_EQ(door.mode() == "CLOSED", c.torque < c.holds);
    EXPECT_EQ(angle(door) < -c.opens, c.torque > c.holds);
  }
}

/// Whether a person of 70 kg who bumps into a latched leaf at a speed (m/s), and continues to push
/// with a torque (N m), opens it.
bool bump_opens(const char* latch_torque, double speed, double torque) {
  constexpr double kArm = 0.7;  // m
  Bench bench;
  bench.add(ground());
  Rig& leaf = add_door(bench, {}, {{"latch_torque", latch_torque}});
  bench.run(0.2);
  const physics::LinkId body = bench.world.links(bench.add(person({kArm, 0.4, 0.001})))[0];
  for (int i = 0; i < 50; ++i) {  // it has its speed when it hits the leaf
    bench.world.drive(body, {0, -speed, 0}, 0.0, 1e4);
    bench.tick();
  }
  bench.run(0.4 / speed + 2.0, [&] {
    bench.world.drive(body, {0, -speed, 0}, 0.0, torque / kArm);
  });
  return angle(leaf) < -0.05;
}

TEST(Door, ABumpBreaksNoLatchThatTheirPushDoesNot) {
  for (const double speed : {0.1, 0.3, 0.6}) {
    EXPECT_FALSE(bump_opens("110", speed, 105.0)) << speed;
    EXPECT_TRUE(bump_opens("110", speed, 125.0)) << speed;
  }
}

TEST(Door, ALatchThatNearlyBrokeHoldsAgain) {
  Bench bench;
  Rig& door = add_door(bench, {}, {{"latch_torque", "50"}, {"brake_torque", "40"}});
  bench.run(0.2);
  const physics::JointId hinge = bench.world.joints(door.id())[1];
  for (int i = 0; i < 20 && angle(door) > -1e-4; ++i) {
    bench.run(0.02, [&] { bench.world.add_force(hinge, -80.0); });
  }
  EXPECT_GT(angle(door), -0.009) << "not yet out of the latch's reach";
  bench.run(1.0);
  const double rests = angle(door);
  bench.run(2.0, [&] { bench.world.add_force(hinge, -45.0); });
  EXPECT_NEAR(angle(door), rests, 1e-4);
}

TEST(Door, WithoutALatchItsBrakeHoldsIt) {
  Bench bench;
  Rig& door = add_door(bench, {}, {{"latch_torque", "0"}});
  bench.run(0.2);
  const physics::JointId hinge = bench.world.joints(door.id())[1];
  bench.run(1.0, [&] { bench.world.add_force(hinge, -15.0); });
  EXPECT_EQ(door.mode(), "CLOSED");
  bench.run(1.0, [&] { bench.world.add_force(hinge, -40.0); });
  EXPECT_LT(angle(door), -0.1);
}

}  // namespace
}  // namespace angen::test
