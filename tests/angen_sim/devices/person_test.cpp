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

TEST(Person, AWallStopsItItPushesWithNoMoreThanItsForceAndGoesOnWhenFreed) {
  Walk walk(kStraight);
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
  EXPECT_GT(rest, 2.0);  // the path waited: what was left of it takes its time
  EXPECT_NEAR(walk.place().x(), 5.0, 0.02);
}

TEST(Person, SlidingAlongALeafIsNoProgress) {
  Walk walk(kStraight);
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

TEST(Person, PushesALightBoxAlong) {
  Walk walk(kStraight);
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
  // It brakes from 1 m/s with 0.7 of its force: 1 / (2 * 106 / 70) m.
  EXPECT_LT(walk.place().x(), 2.0 + 0.33 + 0.02);
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

}  // namespace
}  // namespace angen::test
