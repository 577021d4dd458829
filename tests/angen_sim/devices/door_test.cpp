#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "angen_sim/devices/doors.h"

namespace angen::test {
namespace {

/// In the way of an opening leaf 0.9 m wide, near its edge, at about this angle.
Vec3 before_edge(double at) {
  const Vec3 along(std::cos(at), std::sin(at), 0.0);
  const Vec3 ahead(std::sin(at), -std::cos(at), 0.0);
  return 0.87 * along + 0.045 * ahead;
}

TEST(Door, OpensInTimeAndArrivesGently) {
  for (const double mass : {8.0, 20.0, 25.0}) {
    Bench bench;
    DoorMeasures measures;
    measures.mass = mass;
    Rig& door = add_door(bench, measures);
    bench.run(0.1);
    ASSERT_TRUE(door.command("Open").accepted);
    double arrival = 0.0;
    const double took = bench.run_until(4.0, [&] {
      if (angle(door) > -1.55) arrival = std::abs(door.at("hinge").velocity);
      return door.mode() == "OPEN";
    });
    printf("door %.0f kg: open after %.3f s, at -1.55 rad %.3f rad/s, rests at %.5f rad\n", mass,
           took, arrival, angle(door));
    EXPECT_GT(took, 0.0) << mass;
    EXPECT_LT(arrival, 1.0) << mass;
    EXPECT_NEAR(angle(door), -1.57, 0.02) << mass;
    EXPECT_GT(door.count("opening"), 0);
    EXPECT_GT(door.count("opened"), 0);
  }
}

TEST(Door, OvershootsAnAngleAwayFromTheStopByLessThanFivePercent) {
  for (const double mass : {8.0, 20.0, 25.0}) {
    Bench bench;
    DoorMeasures measures;
    measures.mass = mass;
    Rig& door = add_door(bench, measures);
    ASSERT_TRUE(door.command("Set -1.2").accepted);
    double deepest = 0.0;
    bench.run(6.0, [&] { deepest = std::min(deepest, angle(door)); });
    printf("door %.0f kg: overshoot %.2f %%, rests at %.5f rad\n", mass,
           100.0 * (deepest / -1.2 - 1.0), angle(door));
    EXPECT_GT(deepest, -1.2 * 1.05) << mass;
    EXPECT_NEAR(angle(door), -1.2, 0.006) << mass;
    EXPECT_EQ(door.mode(), "AJAR") << mass;
  }
}

// An angle in degrees is rounded: -90 are -1.5708 rad, and the hinge ends at -1.57.
TEST(Door, TakesAnAngleThatIsRoundedBeyondItsHinge) {
  Bench bench;
  Rig& door = add_door(bench);
  EXPECT_FALSE(door.command("Set -1.58").accepted);
  ASSERT_TRUE(door.command("Set -1.5708").accepted);
  bench.run(6.0);
  EXPECT_NEAR(angle(door), -1.57, 0.006);
  EXPECT_EQ(door.mode(), "OPEN");
}

TEST(Door, ClosesWithinTwoMilliradians) {
  Bench bench;
  DoorMeasures measures;
  measures.angle = -1.57;
  Rig& door = add_door(bench, measures);
  bench.run(0.1);
  EXPECT_EQ(door.mode(), "OPEN");
  ASSERT_TRUE(door.command("close").accepted);
  const double took = bench.run_until(4.0, [&] { return door.mode() == "CLOSED"; });
  printf("door: closed after %.3f s at %.5f rad\n", took, angle(door));
  EXPECT_GT(took, 0.0);
  EXPECT_NEAR(angle(door), 0.0, 0.002);
}

TEST(Door, ASettledDoorDoesNothingAndStaysWhereItIsForAMinute) {
  for (const double start : {0.0, -0.8, -1.57}) {
    Bench bench;
    DoorMeasures measures;
    measures.angle = start;
    Rig& door = add_door(bench, measures);
    bench.run(1.0);
    const int calls = door.calls;
    bench.run(60.0);
    printf("door at %.2f rad: moved %.2g rad in 60 s, %s\n", start, angle(door) - start,
           door.body("leaf").awake ? "awake" : "asleep");
    EXPECT_NEAR(angle(door), start, 0.001);
    EXPECT_EQ(door.calls, calls);
    EXPECT_EQ(door.forces, 0);
    EXPECT_FALSE(door.body("leaf").awake);
  }
}

TEST(Door, AddsNoForceOnceItHasArrivedAndSleeps) {
  Bench bench;
  Rig& door = add_door(bench);
  door.command("Open");
  ASSERT_GT(bench.run_until(4.0, [&] { return door.mode() == "OPEN"; }), 0.0);
  const int forces = door.forces;
  EXPECT_GT(forces, 0);
  const double before = angle(door);
  bench.run(5.0);
  EXPECT_EQ(door.forces, forces);
  EXPECT_FALSE(door.body("leaf").awake);
  EXPECT_NEAR(angle(door), before, 0.001);
}

TEST(Door, WakesFromSleepAndGoesBack) {
  Bench bench;
  Rig& door = add_door(bench);
  for (const char* word : {"Open", "Close", "Open", "Close"}) {
    ASSERT_TRUE(door.command(word).accepted);
    bench.run(6.0);
    EXPECT_EQ(door.mode(), word[0] == 'O' ? "OPEN" : "CLOSED");
  }
}

TEST(Door, TurnsRoundOnTheWay) {
  Bench bench;
  Rig& door = add_door(bench);
  door.command("Open");
  bench.run(1.0);
  EXPECT_EQ(door.mode(), "OPENING");
  door.command("Close");
  bench.tick();
  EXPECT_EQ(door.mode(), "CLOSING");
  EXPECT_GT(bench.run_until(4.0, [&] { return door.mode() == "CLOSED"; }), 0.0);
}

TEST(Door, HeldByAPostItIsBlockedWithinASecondAndItsEdgeForceIsLimited) {
  Bench bench;
  Rig& door = add_door(bench);
  bench.add(box("post", before_edge(-0.8) + Vec3(0, 0, 1.0), {0.04, 0.04, 2.0}));
  door.command("Open");
  ASSERT_GT(
      bench.run_until(4.0, [&] { return door.at("hinge").velocity > -0.01 && angle(door) < -0.5; }),
      0.0);
  const double to_blocked = bench.run_until(1.0, [&] { return door.mode() == "BLOCKED"; });
  EXPECT_GT(to_blocked, 0.0);
  double greatest = 0.0;
  bench.run(20.0,
            [&] { greatest = std::max(greatest, bench.contact_force("post", "door").norm()); });
  printf("door held: BLOCKED after %.3f s, then at most %.1f N at its edge\n", to_blocked,
         greatest);
  EXPECT_LE(greatest, 150.0);
  EXPECT_GT(greatest, 50.0);
  EXPECT_GT(door.count("blocked"), 0);
}

TEST(Door, ItsFirstBlowIsNoMoreThanTheLeafsOwnMomentum) {
  Bench bench;
  Rig& door = add_door(bench);
  bench.add(box("post", before_edge(-0.8) + Vec3(0, 0, 1.0), {0.04, 0.04, 2.0}));
  door.command("Open");
  double speed = 0.0;
  double peak = 0.0;
  double impulse = 0.0;
  int ticks_since = 0;
  constexpr int kWindow = 50;  // ms
  ASSERT_GT(bench.run_until(4.0,
                            [&] {
                              const double force = bench.contact_force("post", "door").norm();
                              if (force == 0.0 && impulse == 0.0) {
                                speed = std::abs(door.at("hinge").velocity);
                                return false;
                              }
                              peak = std::max(peak, force);
                              impulse += 0.001 * force;
                              return ++ticks_since == kWindow;
                            }),
            0.0);
  const double inertia = door.limits(door.joint("hinge")).inertia;
  const double momentum = inertia * speed / 0.85;
  printf("door meets a post at %.2f rad/s (%.2f J): %.2f N s of %.2f, peak %.0f N\n", speed,
         0.5 * inertia * speed * speed, impulse, momentum, peak);
  EXPECT_LT(0.5 * inertia * speed * speed, 1.69);
  EXPECT_LT(impulse, 1.1 * momentum + 150.0 * 0.001 * kWindow);
}

TEST(Door, GoesOnWhenFreed) {
  Bench bench;
  Rig& door = add_door(bench);
  const physics::ModelId post =
      bench.add(box("post", before_edge(-0.8) + Vec3(0, 0, 1.0), {0.04, 0.04, 2.0}));
  door.command("Open");
  bench.run(6.0);
  ASSERT_EQ(door.mode(), "BLOCKED");
  bench.world.remove(post);
  double fastest = 0.0;
  const double took = bench.run_until(6.0, [&] {
    fastest = std::max(fastest, std::abs(door.at("hinge").velocity));
    return door.mode() == "OPEN";
  });
  printf("door freed: open after %.2f s, at most %.2f rad/s\n", took, fastest);
  EXPECT_GT(took, 0.0);
  EXPECT_LT(fastest, 1.5);
}

TEST(Door, PushesALooseBoxIntoAWallByLessThanAMillimetre) {
  Bench bench;
  Rig& door = add_door(bench);
  bench.add(ground());
  // A loose box, then a wall: both in the leaf's way at -0.8 rad.
  const Vec3 at = before_edge(-0.8) + Vec3(-0.1, -0.2, 0.15);
  bench.add(box("crate", at, {0.3, 0.3, 0.3}, 5.0));
  bench.add(box("wall", at + Vec3(0, -0.25, 0.35), {2.0, 0.1, 1.0}));
  bench.add(box("side", at + Vec3(-0.25, 0, 0.35), {0.1, 0.5, 1.0}));
  door.command("Open");
  double deepest = 0.0;
  bench.run(15.0, [&] {
    for (const ContactPair& pair : bench.world.contacts()) {
      const bool crate = pair.first.rfind("crate", 0) == 0 || pair.second.rfind("crate", 0) == 0;
      const bool wall = pair.first.rfind("wall", 0) == 0 || pair.second.rfind("wall", 0) == 0 ||
                        pair.first.rfind("side", 0) == 0 || pair.second.rfind("side", 0) == 0;
      if (!crate || !wall) continue;
      for (const ContactPoint& point : pair.points) deepest = std::max(deepest, point.depth);
    }
  });
  printf("door pushes a crate into a wall by %.4f mm\n", 1000.0 * deepest);
  EXPECT_EQ(door.mode(), "BLOCKED");
  EXPECT_LT(deepest, 0.001);
}

TEST(Door, PushedByHandItIsAjarAndStaysThere) {
  Bench bench;
  DoorMeasures measures;
  measures.angle = -1.57;
  Rig& door = add_door(bench, measures);
  bench.run(1.0);
  const physics::JointId hinge = bench.world.joints(door.id())[1];
  bench.run(0.5, [&] { bench.world.add_force(hinge, 40.0); });
  bench.run(3.0);
  EXPECT_GT(angle(door), -1.5);
  EXPECT_EQ(door.mode(), "AJAR");
  const double left = angle(door);
  bench.run(10.0);
  EXPECT_NEAR(angle(door), left, 0.001);
}

TEST(Door, WarnsOfWhatItsJointsEffortCaps) {
  Bench bench;
  desc::Model model = door();
  model.joints[1].axes[0].effort = 50.0;
  Rig& capped = bench.add(model, "libdoor_world_plugin.so", "door", {{"brake_torque", "80"}});
  ASSERT_EQ(capped.warnings.size(), 1U);
  EXPECT_NE(capped.warnings[0].message.find("80"), std::string::npos);
  EXPECT_NE(capped.warnings[0].message.find("50"), std::string::npos);
  model.name = "other";
  EXPECT_TRUE(bench.add(model, "libdoor_world_plugin.so", "door", {{"brake_torque", "50"}})
                  .warnings.empty());
}

TEST(Door, RejectsWhatItDoesNotKnowAndStaysAsItIs) {
  Bench bench;
  Rig& door = add_door(bench);
  bench.run(0.1);
  for (const char* text : {"", "Opne", "Set", "Set x", "Set 1.0", "Set nan", "Set -1.2 3"}) {
    const Verdict verdict = door.command(text);
    EXPECT_FALSE(verdict.accepted) << text;
    EXPECT_FALSE(verdict.reason.empty()) << text;
  }
  bench.run(1.0);
  EXPECT_EQ(door.mode(), "CLOSED");
  EXPECT_EQ(door.forces, 0);
}

TEST(Door, RejectsParametersThatDoNotFitTheHinge) {
  Bench bench;
  EXPECT_THROW(add_door(bench, {}, {{"open_position", "1.57"}}), Error);
  EXPECT_THROW(add_door(bench, {}, {{"p", "-1"}}), Error);
  EXPECT_THROW(add_door(bench, {}, {{"update_rate", "1e10"}}), Error);
  EXPECT_THROW(add_door(bench, {}, {{"colour", "red"}}), Error);
}

}  // namespace
}  // namespace angen::test
