#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "angen_sim/devices/elevators.h"

namespace angen::test {
namespace {

TEST(Elevator, ServesAFloorAndComesBackInTimeWhateverItCarries) {
  for (const double cabin : {84.0, 400.0}) {
    for (const double load : {0.0, 6.3, 200.0}) {
      Bench bench;
      Rig& rig = add_elevator(bench, cabin);
      if (load > 0.0) bench.add(box("load", {0.2, 0.1, 0.21}, {0.4, 0.4, 0.4}, load));
      ASSERT_GT(bench.run_until(4.0, [&] { return standing_open(rig, 0); }), 0.0);
      bench.run(2.0);
      for (const int floor : {1, 0}) {
        ASSERT_TRUE(rig.command("Floor" + std::to_string(floor)).accepted);
        double past = 0.0;
        double swing = 0.0;
        const double took = bench.run_until(15.0, [&] {
          const double beyond = floor == 1 ? height(rig) - 4.0 : -height(rig);
          past = std::max(past, beyond);
          if (door_mode(rig) == "OPENING")
            swing = std::max(swing, std::abs(height(rig) - 4.0 * floor));
          return standing_open(rig, floor);
        });
        printf("elevator %.0f kg + %.1f kg to floor %d: %.2f s, off %.2f mm, overshoot %.2f mm\n",
               cabin, load, floor, took, 1000.0 * (height(rig) - 4.0 * floor), 1000.0 * past);
        EXPECT_GT(took, 0.0);
        EXPECT_LE(took, 10.0);
        EXPECT_NEAR(height(rig), 4.0 * floor, 0.005);
        EXPECT_LT(past, 0.002);
        bench.run(2.0);
      }
      EXPECT_EQ(rig.count("up"), 1);
      EXPECT_EQ(rig.count("down"), 1);
    }
  }
}

TEST(Elevator, ARobotAboardKeepsItsPlace) {
  Bench bench;
  Rig& rig = add_elevator(bench, 84.0);
  const physics::ModelId robot_id = bench.add(robot({0.1, 0.2, 0.001}));
  bench.run(3.0);
  const physics::LinkId base = bench.world.links(robot_id)[0];
  const Pose before = bench.world.link(base).pose;
  rig.command("Floor1");
  double lifted = 0.0;
  bench.run(10.0, [&] {
    lifted = std::max(lifted, std::abs(bench.world.link(base).pose.position.z() - height(rig) -
                                       before.position.z()));
  });
  const Pose after = bench.world.link(base).pose;
  const double slid = (after.position - before.position).head<2>().norm();
  printf("robot aboard: slid %.3f mm, left the floor by %.3f mm, turned %.5f rad\n", 1000.0 * slid,
         1000.0 * lifted, yaw_of(after.rotation) - yaw_of(before.rotation));
  EXPECT_NEAR(after.position.z(), before.position.z() + 4.0, 0.005);
  EXPECT_LT(slid, 0.002);
  EXPECT_LT(lifted, 0.002);
}

TEST(Elevator, ItsDoorsAreShutWhileItMoves) {
  Bench bench;
  Rig& rig = add_elevator(bench);
  bench.run(3.0);
  rig.command("Floor1");
  double widest = 0.0;
  double other = 0.0;
  bench.run(12.0, [&] {
    const bool away = std::abs(height(rig)) > 0.005 && std::abs(height(rig) - 4.0) > 0.005;
    for (const char* leaf : {"cabin_door_left", "cabin_door_right", "landing_door_0_left",
                             "landing_door_0_right", "landing_door_1_left"}) {
      if (away) widest = std::max(widest, std::abs(rig.at(leaf).position));
    }
    if (height(rig) < 3.99)
      other = std::max(other, std::abs(rig.at("landing_door_1_right").position));
    if (height(rig) > 0.01)
      other = std::max(other, std::abs(rig.at("landing_door_0_right").position));
  });
  printf("elevator doors while moving: at most %.2f mm open\n", 1000.0 * widest);
  EXPECT_LT(widest, 0.002);
  EXPECT_LT(other, 0.002);
  EXPECT_NEAR(rig.at("cabin_door_left").position, 0.42, 0.002);
  EXPECT_NEAR(rig.at("landing_door_1_left").position, 0.42, 0.002);
  EXPECT_NEAR(rig.at("landing_door_0_left").position, 0.0, 0.002);
}

TEST(Elevator, OfTheCallsThatWaitTheNewestHolds) {
  Bench bench;
  Rig& rig = add_elevator(bench);
  bench.run(3.0);
  rig.command("Floor1");
  bench.run(3.0);
  ASSERT_EQ(rig.mode(), "UP");
  rig.command("Floor0");
  rig.command("Floor1");
  bench.run(20.0);
  EXPECT_TRUE(standing_open(rig, 1)) << "where it was going is where it was called last";
  EXPECT_EQ(rig.count("arrived"), 1);
  rig.command("Floor0");
  bench.run(4.0);
  ASSERT_EQ(rig.mode(), "DOWN");
  rig.command("Floor1");
  bench.run(30.0);
  EXPECT_TRUE(standing_open(rig, 1)) << "one call waits while it moves";
  EXPECT_EQ(rig.count("arrived"), 3);
}

TEST(Elevator, CallsWhileItMovesAreQueuedAndAFullQueueLosesItsOldest) {
  struct Case {
    const char* queue_size;
    std::vector<const char*> calls;
    std::vector<std::int64_t> stops;
  };
  for (const Case& each : {Case{"2", {"Floor0", "Floor1", "Floor0"}, {1, 0}},
                           Case{"100", {"Floor0", "Floor1"}, {1, 0, 1}}}) {
    SCOPED_TRACE(each.queue_size);
    Bench bench;
    Rig& rig = add_elevator(bench, 400.0, {{"queue_size", each.queue_size}});
    bench.run(3.0);
    rig.command("Floor1");
    bench.run(3.0);
    EXPECT_EQ(rig.mode(), "UP");
    for (const char* call : each.calls) rig.command(call);
    std::vector<std::int64_t> seen;
    bench.run(40.0, [&] {
      const std::int64_t floor = door_mode(rig) == "OPEN" ? floor_of(rig) : -1;
      if (floor >= 0 && (seen.empty() || seen.back() != floor)) seen.push_back(floor);
    });
    EXPECT_EQ(seen, each.stops);
    EXPECT_EQ(rig.count("arrived"), 3);
  }
}

TEST(Elevator, ItsDoorReopensOnAnObstacleAndShutsWhenItIsGone) {
  Bench bench;
  Rig& rig = add_elevator(bench);
  bench.run(3.0);
  const physics::ModelId post = bench.add(box("post", {0.0, -0.72, 1.0}, {0.2, 0.02, 1.9}));
  rig.command("Floor1");
  double greatest = 0.0;
  bench.run(10.0, [&] { greatest = std::max(greatest, std::abs(height(rig))); });
  EXPECT_GE(rig.count("obstacle"), 2);
  EXPECT_LT(greatest, 0.001);
  EXPECT_EQ(floor_of(rig), 0);
  bench.world.remove(post);
  EXPECT_GT(bench.run_until(15.0, [&] { return standing_open(rig, 1); }), 0.0);
}

// EN 81-20, 5.3.6.2.2.1: its doors close with 150 N at most, and open again before they touch.
TEST(Elevator, ItsLeavesDoNotHurtAPersonInTheDoor) {
  for (const double x : {0.0, 0.12, -0.16}) {
    Bench bench;
    bench.add(ground(-0.1));
    Rig& rig = add_elevator(bench);
    bench.add(box("sill", {0.0, -2.0, -0.05}, {2.0, 2.5, 0.1}));
    ASSERT_GT(bench.run_until(4.0, [&] { return standing_open(rig, 0); }), 0.0);
    bench.run(1.5);
    bench.add(person({x, -0.77, 0.001}));
    rig.command("Floor1");
    double worst = 0.0;
    bench.run(8.0, [&] {
      for (const char* leaf : {"elevator::cabin_door", "elevator::landing_door"}) {
        worst = std::max(worst, bench.contact_force("person", leaf).norm());
      }
    });
    printf("a person at %.2f m in the door: leaves press with at most %.0f N\n", x, worst);
    EXPECT_LT(worst, 150.0) << x;
    EXPECT_LT(height(rig), 0.001);
    EXPECT_GT(rig.count("obstacle"), 0);
  }
}

// ISO/TS 15066: a chest yields by 1 m per 25 kN. Whoever walks into a leaf is stopped by v sqrt(k
// m).
TEST(Elevator, AWalkingPersonIsStoppedByALeafAsByASpring) {
  for (const Vec3& way : {Vec3(0.0, 1.0, 0.0), Vec3(0.0, -1.0, 0.0), Vec3(1.0, 0.0, 0.0)}) {
    Bench bench;
    bench.add(ground(-0.1));
    Rig& rig = add_elevator(bench);
    bench.add(box("sill", {0.0, -2.0, -0.05}, {2.0, 2.5, 0.1}));
    ASSERT_GT(bench.run_until(4.0, [&] { return standing_open(rig, 0); }), 0.0);
    bench.run(1.5);
    rig.command("Floor1");
    // Into the middle of a closing leaf from outside or inside, or into its edge.
    const bool edge = way.x() > 0.0;
    const Vec3 at = edge ? Vec3(-0.05, -0.77, 0.001) : Vec3(0.35, -0.77, 0.001) - 0.6 * way;
    const physics::ModelId id = bench.add(person(at));
    const physics::LinkId body = bench.world.links(id)[0];
    double worst = 0.0, farthest = 0.0, back = 0.0;
    bench.run(2.0, [&] {
      bench.world.drive(body, way, 0.0, 150.0);
      for (const char* leaf : {"elevator::cabin_door", "elevator::landing_door"}) {
        worst = std::max(worst, bench.contact_force("person", leaf).norm());
      }
      const physics::LinkState state = bench.world.link(body);
      farthest = std::max(farthest, way.dot(state.pose.position - at));
      back = std::max(back, -way.dot(state.linear_velocity));
    });
    printf("a person walks into a leaf: %.0f N, %.3f m, back at %.2f m/s\n", worst, farthest, back);
    const double spring = std::sqrt(25e3 * 70.0);  // N, at 1 m/s
    EXPECT_GT(worst, 0.3 * spring) << way.transpose();
    EXPECT_LT(worst, 1.15 * spring) << way.transpose();
    EXPECT_LT(farthest, 0.5) << "it does not walk through the leaf";
    EXPECT_LT(back, 0.2) << "it does not bounce";
  }
}

TEST(Elevator, HeldItIsBlockedAndGoesOnWhenFreed) {
  Bench bench;
  Rig& rig = add_elevator(bench);
  bench.run(3.0);
  const physics::ModelId beam = bench.add(box("beam", {0, 0, 4.0}, {3.0, 0.1, 0.2}));
  rig.command("Floor1");
  ASSERT_GT(
      bench.run_until(10.0, [&] { return height(rig) > 1.5 && rig.at("lift").velocity < 0.005; }),
      0.0);
  const double took = bench.run_until(1.0, [&] { return rig.mode() == "BLOCKED"; });
  printf("elevator held: BLOCKED after %.3f s at %.3f m\n", took, height(rig));
  EXPECT_GT(took, 0.0);
  bench.run(5.0);
  bench.world.remove(beam);
  EXPECT_GT(bench.run_until(12.0, [&] { return standing_open(rig, 1); }), 0.0);
  EXPECT_NEAR(height(rig), 4.0, 0.005);
}

TEST(Elevator, StandingItBrakesAndSpendsNothing) {
  Bench bench;
  Rig& rig = add_elevator(bench, 84.0);
  bench.add(box("load", {0, 0, 0.21}, {0.4, 0.4, 0.4}, 200.0));
  rig.command("Floor1");
  ASSERT_GT(bench.run_until(15.0, [&] { return standing_open(rig, 1); }), 0.0);
  bench.run(2.0);
  const double before = height(rig);
  const int calls = rig.calls;
  bench.run(60.0);
  printf("elevator standing: moved %.3g mm in 60 s, %s\n", 1000.0 * (height(rig) - before),
         rig.body("cabin").awake ? "awake" : "asleep");
  EXPECT_NEAR(height(rig), before, 0.0005);
  EXPECT_EQ(rig.calls, calls);
  EXPECT_FALSE(rig.body("cabin").awake);
}

TEST(Elevator, RejectsFloorsThatItHasNot) {
  Bench bench;
  Rig& rig = add_elevator(bench);
  bench.run(3.0);
  for (const char* text :
       {"", "Floor", "Floor2", "Floor-1", "Floor1.5", "Floor99999999999", "Up"}) {
    EXPECT_FALSE(rig.command(text).accepted) << text;
  }
  EXPECT_NE(rig.command("Floor7").reason.find("Floor0 to Floor1"), std::string::npos);
  bench.run(2.0);
  EXPECT_TRUE(standing_open(rig, 0));
}

}  // namespace
}  // namespace angen::test
