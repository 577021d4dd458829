#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "angen_sim/devices/models.h"
#include "angen_sim/devices/rig.h"

namespace angen::test {
namespace {

struct Walk {
  Bench bench;
  Rig* rig = nullptr;

  explicit Walk(const Parameters& parameters, const Vec3& start = {0, 0, 0.001}) {
    bench.add(ground());
    rig = &bench.add(person(start), "libperson_controller.so", "person", parameters);
  }
  Vec3 place() const { return rig->body("body").pose.position; }
  double get(const char* name) const { return rig->state().get<double>(name); }
};

const Parameters kStraight{{"waypoint", "0 0 0 0 0"}, {"waypoint", "5 5 0 0 0"}, {"loop", "false"}};

TEST(Person, IsWhereItsWaypointsSay) {
  Walk walk(Parameters{{"waypoint", "0 0 0 0 0"},
                       {"waypoint", "4 4 0 0 1.57"},
                       {"waypoint", "6 4 0 0 1.57"},
                       {"waypoint", "9 4 3 0 1.57"},
                       {"loop", "false"}});
  walk.bench.run(2.0);
  EXPECT_LT((walk.place() - Vec3(2, 0, walk.place().z())).norm(), 0.1);
  EXPECT_EQ(walk.rig->mode(), "WALKING");
  EXPECT_NEAR(walk.get("speed"), 1.0, 0.1);
  EXPECT_NEAR(walk.get("yaw"), 0.0, 0.05);
  walk.bench.run(3.8);
  EXPECT_EQ(walk.rig->mode(), "STANDING");
  EXPECT_LT((walk.place() - Vec3(4, 0, walk.place().z())).norm(), 0.02);
  EXPECT_NEAR(walk.get("yaw"), 1.57, 0.05);
  walk.bench.run(6.0);
  EXPECT_LT((walk.place() - Vec3(4, 3, walk.place().z())).norm(), 0.02);
  EXPECT_EQ(walk.rig->mode(), "STANDING");
}

TEST(Person, WalksItsLoopInTimeAndCutsCornersByLessThanTwentyCentimetres) {
  Walk walk(Parameters{{"waypoint", "0 0 0 0 0"},
                       {"waypoint", "2 2 0 0 0"},
                       {"waypoint", "4 2 2 0 0"},
                       {"waypoint", "6 0 2 0 0"},
                       {"waypoint", "8 0 0 0 0"}});
  double behind = 0.0;
  double aside = 0.0;
  walk.bench.run(30.0, [&] {
    const double t = std::fmod(to_seconds(walk.bench.now()), 8.0);
    const Vec3 should = t < 2   ? Vec3(t, 0, 0)
                        : t < 4 ? Vec3(2, t - 2, 0)
                        : t < 6 ? Vec3(6 - t, 2, 0)
                                : Vec3(0, 8 - t, 0);
    const Vec3 at = walk.place();
    behind = std::max(behind, (at - should).head<2>().norm());
    // From the sides of the square of 2 m.
    const double x = std::abs(at.x() - 1.0);
    const double y = std::abs(at.y() - 1.0);
    aside = std::max(aside, std::abs(std::max(x, y) - 1.0));
  });
  printf("person: at most %.3f m behind, %.3f m aside of its path\n", behind, aside);
  EXPECT_LT(behind, 0.3);
  EXPECT_LT(aside, 0.2);
}

TEST(Person, WaitsForItsDelay) {
  Parameters delayed = kStraight;
  delayed.push_back({"delay_start", "3"});
  Walk walk(delayed);
  walk.bench.run(2.5);
  EXPECT_EQ(walk.rig->mode(), "STANDING");
  EXPECT_LT(walk.place().head<2>().norm(), 0.01);
  walk.bench.run(2.5);
  EXPECT_NEAR(walk.place().x(), 2.0, 0.1);
}

Parameters without_avoiding(Parameters parameters) {
  parameters.push_back({"avoid", "false"});
  return parameters;
}

TEST(Person, AWallStopsItItPushesWithNoMoreThanItsForceAndGoesOnWhenFreed) {
  Walk walk(without_avoiding(kStraight));
  const physics::ModelId wall = walk.bench.add(box("wall", {2.0, 0, 1}, {0.1, 3, 2}));
  ASSERT_GT(walk.bench.run_until(6.0,
                                 [&] {
                                   return walk.rig->body("body").linear_velocity.x() < 0.01 &&
                                          walk.place().x() > 1.5;
                                 }),
            0.0);
  const double took = walk.bench.run_until(2.0, [&] { return walk.rig->mode() == "BLOCKED"; });
  double push = 0.0;
  walk.bench.run(5.0,
                 [&] { push = std::max(push, walk.bench.contact_force("wall", "person").norm()); });
  printf("person held: BLOCKED after %.2f s, pushes with %.1f N\n", took, push);
  EXPECT_GT(took, 0.0);
  EXPECT_LE(took, 1.15);
  EXPECT_LE(push, 151.0);
  EXPECT_LT(walk.place().x(), 1.81);
  walk.bench.world.remove(wall);
  const double rest = walk.bench.run_until(12.0, [&] { return walk.rig->mode() == "STANDING"; });
  EXPECT_GT(rest, 2.0);  // the path waited: the rest of it takes its time
  EXPECT_NEAR(walk.place().x(), 5.0, 0.02);
}

TEST(Person, SlidingAlongALeafIsNoProgress) {
  Walk walk(without_avoiding(kStraight));
  desc::Model leaf = box("leaf", {2.0, 0, 1}, {0.05, 6, 2});
  leaf.pose.rotation = from_rpy(0, 0, 0.3);
  walk.bench.add(leaf);
  ASSERT_GT(walk.bench.run_until(
                4.0, [&] { return walk.bench.contact_force("leaf", "person").norm() > 0.0; }),
            0.0);
  const Vec3 touched = walk.place();
  const double took = walk.bench.run_until(5.0, [&] { return walk.rig->mode() == "BLOCKED"; });
  printf("person leaning on a leaf: slid %.2f m, BLOCKED after %.2f s\n",
         (walk.place() - touched).head<2>().norm(), took);
  EXPECT_GT((walk.place() - touched).head<2>().norm(), 0.1);
  EXPECT_GT(took, 0.0);
  EXPECT_LE(took, 1.5);
}

TEST(Person, PushesALightBoxAlongWhereItDoesNotAvoid) {
  Walk walk(without_avoiding(kStraight));
  walk.bench.add(box("crate", {1.5, 0, 0.151}, {0.3, 0.3, 0.3}, 5.0));
  walk.bench.run(7.0);
  EXPECT_NEAR(walk.place().x(), 5.0, 0.1);
}

TEST(Person, StandingCostsNothingAndSleeps) {
  Walk walk(kStraight);
  walk.bench.run(7.0);
  ASSERT_EQ(walk.rig->mode(), "STANDING");
  const int calls = walk.rig->calls;
  walk.bench.run(20.0);
  EXPECT_EQ(walk.rig->calls, calls);
  EXPECT_FALSE(walk.rig->body("body").awake);
}

TEST(Person, StopsAndGoes) {
  Walk walk(kStraight);
  walk.bench.run(2.0);
  ASSERT_TRUE(walk.rig->command("Stop").accepted);
  walk.bench.run(5.0);
  EXPECT_EQ(walk.rig->mode(), "STANDING");
  // It brakes from 1 m/s with its force: 1 / (2 * 150 / 70) m.
  EXPECT_LT(walk.place().x(), 2.0 + 0.233 + 0.02);
  ASSERT_TRUE(walk.rig->command("go").accepted);
  walk.bench.run(4.0);
  EXPECT_NEAR(walk.place().x(), 5.0, 0.05);
  EXPECT_FALSE(walk.rig->command("Run").accepted);
}

TEST(Person, WithoutWaypointsItStandsWhereItIs) {
  Walk walk(Parameters{}, {1.0, 2.0, 0.001});
  walk.bench.run(3.0);
  EXPECT_EQ(walk.rig->mode(), "STANDING");
  EXPECT_LT((walk.place().head<2>() - Eigen::Vector2d(1, 2)).norm(), 0.01);
}

TEST(Person, TimesOfWaypointsMustRise) {
  const Parameters parameters{{"waypoint", "1 0 0 0 0"}, {"waypoint", "1 5 0 0 0"}};
  EXPECT_THROW(Walk{parameters}, Error);
}

/// The farthest that a model's only link got from where it was.
struct Watched {
  Bench& bench;
  physics::LinkId link;
  Vec3 start;
  double moved = 0.0;

  Watched(Bench& bench_, const desc::Model& model)
      : bench(bench_),
        link(bench.world.links(bench.add(model))[0]),
        start(bench.world.link(link).pose.position) {}
  void see() { moved = std::max(moved, (bench.world.link(link).pose.position - start).norm()); }
};

desc::Model crate(const Vec3& at, double mass = 60.0) {
  return box("crate", at + Vec3(0, 0, 0.301), {0.6, 0.6, 0.6}, mass);
}

TEST(Person, StopsBeforeAWallThatItSeesAndGoesOnWhenFreed) {
  Walk walk(kStraight);
  const physics::ModelId wall = walk.bench.add(box("wall", {2.0, 0, 1}, {0.1, 8, 2}));
  double push = 0.0;
  double farthest = 0.0;
  bool blocked = false;
  walk.bench.run(12.0, [&] {
    push = std::max(push, walk.bench.contact_force("wall", "person").norm());
    farthest = std::max(farthest, walk.place().x());
    blocked = blocked || walk.rig->mode() == "BLOCKED";
  });
  printf("person before a wall at 1.95 m comes up to %.3f m and pushes with %.1f N\n", farthest,
         push);
  EXPECT_TRUE(blocked);
  EXPECT_EQ(push, 0.0);
  EXPECT_GT(farthest, 1.5);
  EXPECT_LT(farthest, 1.95 - 0.25 - 0.05);
  walk.bench.world.remove(wall);
  EXPECT_GT(walk.bench.run_until(20.0, [&] { return walk.rig->mode() == "STANDING"; }), 0.0);
  EXPECT_NEAR(walk.place().x(), 5.0, 0.02);
}

TEST(Person, WalksRoundACrateOnItsPathAndComesBackToIt) {
  for (const double aside : {-0.2, 0.0, 0.2}) {
    Walk walk(kStraight);
    Watched stays(walk.bench, crate({2.5, aside, 0}));
    double off = 0.0;
    const double took = walk.bench.run_until(15.0, [&] {
      stays.see();
      off = std::max(off, std::abs(walk.place().y()));
      return walk.place().x() > 4.97;
    });
    printf("person round a crate %.1f m aside: %.2f s for 5 m, %.2f m off, crate moved %.1e m\n",
           aside, took, off, stays.moved);
    EXPECT_GT(took, 0.0);
    EXPECT_LT(took, 9.0);
    EXPECT_LT(off, 1.5);
    EXPECT_LT(stays.moved, 2e-3);
    EXPECT_LT(std::abs(walk.place().y()), 0.1);
  }
}

TEST(Person, GoesWhereItIsSentRoundWhatStandsInTheWay) {
  Walk walk(Parameters{});
  Watched stays(walk.bench, crate({2.0, 0, 0}));
  walk.bench.run(0.2);
  ASSERT_TRUE(walk.rig->command("GoTo 4 0.5").accepted);
  const double took = walk.bench.run_until(15.0, [&] {
    stays.see();
    return walk.rig->mode() == "STANDING" && walk.place().x() > 3.0;
  });
  printf("person sent 4 m past a crate: there after %.2f s\n", took);
  EXPECT_GT(took, 0.0);
  EXPECT_LT(took, 8.0);
  EXPECT_LT((walk.place().head<2>() - Eigen::Vector2d(4, 0.5)).norm(), 0.05);
  EXPECT_LT(stays.moved, 2e-3);
  walk.bench.run(2.0);
  EXPECT_FALSE(walk.rig->body("body").awake);
  ASSERT_TRUE(walk.rig->command("Go").accepted);  // back to its path: where it had stopped
  walk.bench.run(12.0);
  EXPECT_LT(walk.place().head<2>().norm(), 0.1);
}

TEST(Person, RejectsToGoNowhere) {
  Walk walk(Parameters{});
  for (const char* text :
       {"GoTo", "GoTo 1", "GoTo 1 x", "GoTo nan 1", "GoTo 1 2 3 4", "PushTo 1"}) {
    const Verdict verdict = walk.rig->command(text);
    EXPECT_FALSE(verdict.accepted) << text;
    EXPECT_NE(verdict.reason.find("GoTo <x> <y>"), std::string::npos) << verdict.reason;
  }
}

TEST(Person, PushesWhatItIsToldToWithNoMoreThanItsForce) {
  Walk walk(Parameters{});
  Watched pushed(walk.bench, crate({1.5, 0, 0}, 10.0));
  walk.bench.run(0.2);
  ASSERT_TRUE(walk.rig->command("PushTo 2.5 0").accepted);
  double push = 0.0;
  double impulse = 0.0;  // N s, of the first 0.1 s
  double touched = -1.0;
  walk.bench.run(20.0, [&] {
    pushed.see();
    const double force = walk.bench.contact_force("crate", "person").norm();
    const double now = to_seconds(walk.bench.now());
    if (force > 0.0 && touched < 0.0) touched = now;
    if (touched < 0.0 || now < touched + 0.1) {
      impulse += force * 1e-3;
    } else {
      push = std::max(push, force);
    }
  });
  printf("person pushes a crate of 10 kg by %.2f m with at most %.0f N, after %.1f N s\n",
         pushed.moved, push, impulse);
  EXPECT_LE(push, 151.0);
  EXPECT_LT(impulse, 0.1 * 150.0 + 70.0 * 0.3);
  EXPECT_NEAR(pushed.moved, 2.5 + 0.25 + 0.3 - 1.5, 0.1);
  EXPECT_LT(walk.place().x(), 2.52);
}

TEST(Person, WaitsAtAShutDoorAndGoesThroughWhenItIsOpen) {
  Walk walk(Parameters{}, {0.45, 2.0, 0.001});
  walk.bench.add(box("left", {-2.0, 0, 1}, {3.98, 0.1, 2}));
  walk.bench.add(box("right", {2.92, 0, 1}, {4.0, 0.1, 2}));
  Rig& leaf = walk.bench.add(door(), "libdoor_world_plugin.so", "door");
  walk.bench.run(0.2);
  ASSERT_TRUE(walk.rig->command("GoTo 0.45 -2").accepted);
  double push = 0.0;
  walk.bench.run(10.0,
                 [&] { push = std::max(push, walk.bench.contact_force("door", "person").norm()); });
  EXPECT_EQ(push, 0.0);
  EXPECT_GT(walk.place().y(), 0.2);
  ASSERT_TRUE(leaf.command("Open").accepted);
  EXPECT_GT(walk.bench.run_until(25.0, [&] { return walk.place().y() < -1.9; }), 0.0)
      << walk.place().transpose();
}

TEST(Person, TwoPeopleAndARobotGetPastEachOtherInACorridor) {
  for (const double at : {-0.3, 0.0, 0.3}) {
    Walk walk(Parameters{}, {0, 0, 0.001});
    Bench& bench = walk.bench;
    bench.add(box("left", {3.5, 1.05, 1}, {12, 0.1, 2}));
    bench.add(box("right", {3.5, -1.05, 1}, {12, 0.1, 2}));
    desc::Model second = person({7, 0, 0.001});
    second.name = "other";
    Rig& other = bench.add(second, "libperson_controller.so", "person");
    desc::Model robot = box("robot", {3.0, at, 0.151}, {0.35, 0.35, 0.3}, 6.0);
    Watched stays(bench, robot);
    bench.run(0.2);
    ASSERT_TRUE(walk.rig->command("GoTo 7 0").accepted);
    ASSERT_TRUE(other.command("GoTo 0 0").accepted);
    double touch = 0.0;
    const double took = bench.run_until(40.0, [&] {
      stays.see();
      touch = std::max(touch, bench.contact_force("other", "person").norm());
      return walk.place().x() > 6.9 && other.body("body").pose.position.x() < 0.1;
    });
    printf(
        "two people and a robot at %.1f in a corridor of 2 m: past after %.1f s, robot moved "
        "%.1e m, they touch with %.0f N\n",
        at, took, stays.moved, touch);
    EXPECT_GT(took, 0.0);
    EXPECT_LT(stays.moved, 2e-3);
    EXPECT_EQ(touch, 0.0);
  }
}

}  // namespace
}  // namespace angen::test
