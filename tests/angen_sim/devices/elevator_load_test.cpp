#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "angen_sim/devices/elevators.h"

namespace angen::test {
namespace {

// EN 81-20, 5.12.1.2: the rated load and a tenth of it, 75 kg at least.
TEST(Elevator, WithAnOverloadItStaysWithOpenDoorsUntilSomethingIsTakenOut) {
  struct Case {
    const char* rated;
    double load;  // kg
    bool leaves;
  };
  for (const Case& c :
       {Case{"630", 690.0, true}, Case{"630", 720.0, false}, Case{"1000", 1085.0, true},
        Case{"1000", 1115.0, false}, Case{"2000", 2180.0, true}, Case{"2000", 2300.0, false}}) {
    Bench bench;
    Rig& rig = add_elevator(bench, 400.0, {{"rated_load", c.rated}});
    const physics::ModelId load = bench.add(box("load", {0.2, 0.1, 0.21}, {0.4, 0.4, 0.4}, c.load));
    bench.run(4.0);
    EXPECT_NEAR(rig.state().get<double>("load"), c.load, 0.01 * c.load);
    ASSERT_TRUE(rig.command("Floor1").accepted);
    double took = bench.run_until(15.0, [&] { return standing_open(rig, 1); });
    printf("rated %s kg, %.0f kg aboard: %s, events %td\n", c.rated, c.load, rig.mode().c_str(),
           rig.count("overloaded"));
    EXPECT_EQ(took > 0.0, c.leaves) << c.load;
    EXPECT_EQ(rig.count("overloaded"), c.leaves ? 0 : 1);
    if (c.leaves) continue;
    EXPECT_EQ(rig.mode(), "OVERLOADED");
    EXPECT_EQ(door_mode(rig), "OPEN");
    EXPECT_NEAR(height(rig), 0.0, 1e-3);
    bench.world.remove(load);
    took = bench.run_until(15.0, [&] { return standing_open(rig, 1); });
    EXPECT_GT(took, 0.0) << "its call waits";
  }
}

TEST(Elevator, WhoComesAboardWhileItsDoorsShutOpensThemByTheirWeight) {
  Bench bench;
  Rig& rig = add_elevator(bench);
  bench.add(box("load", {0.2, 0.1, 0.21}, {0.4, 0.4, 0.4}, 680.0));
  bench.run(4.0);
  rig.command("Floor1");
  bench.run(0.6);
  ASSERT_EQ(door_mode(rig), "CLOSING");
  bench.add(box("more", {-0.4, 0.1, 0.21}, {0.4, 0.4, 0.4}, 60.0));
  bench.run(5.0);
  EXPECT_EQ(rig.mode(), "OVERLOADED");
  EXPECT_EQ(door_mode(rig), "OPEN");
  EXPECT_NEAR(height(rig), 0.0, 1e-3);
}

// What appears in the cabin on the way is weighed by the brake: the drive lifts the mass it knows.
TEST(Elevator, ALoadThatComesOnTheWayIsLiftedOrTold) {
  for (const double load : {600.0, 800.0}) {
    for (const double wait : {1.2, 2.5, 4.0}) {  // s: as it leaves, and at some height
      SCOPED_TRACE(::testing::Message() << load << " kg after " << wait << " s");
      Bench bench;
      Rig& rig = add_elevator(bench);
      bench.run(3.0);
      rig.command("Floor1");
      bench.run(wait);
      const physics::ModelId more =
          bench.add(box("more", {0, 0, height(rig) + 0.21}, {0.4, 0.4, 0.4}, load));
      double fell = 0.0;
      const double took = bench.run_until(30.0, [&] {
        fell = std::max(fell, -rig.at("lift").velocity);
        return standing_open(rig, 1);
      });
      printf("%.0f kg after %.1f s: %s at %.3f m, fell with %.2f m/s\n", load, wait,
             rig.mode().c_str(), height(rig), fell);
      EXPECT_LT(fell, 0.3);
      EXPECT_NEAR(rig.state().get<double>("load"), load, 0.01 * load);
      if (load == 600.0) {
        EXPECT_GT(took, 0.0);
        continue;
      }
      EXPECT_EQ(rig.mode(), "OVERLOADED");
      EXPECT_EQ(rig.count("overloaded"), 1);
      bench.world.remove(more);
      EXPECT_GT(bench.run_until(20.0, [&] { return standing_open(rig, 1); }), 0.0);
    }
  }
}

// The drive knows the mass that it weighed: with another one the cabin would fall, or fly up.
TEST(Elevator, ALoadThatComesOrLeavesOnTheWayDoesNotMakeItFast) {
  for (const bool up : {true, false}) {
    for (const bool comes : {true, false}) {
      for (const double load : {100.0, 600.0}) {
        for (const double wait : {0.5, 3.0}) {  // s, since the cabin moves
          SCOPED_TRACE(::testing::Message() << (up ? "up " : "down ") << comes << " " << load
                                            << " kg after " << wait << " s");
          Bench bench;
          Rig& rig = add_elevator(bench);
          if (!up) {
            rig.command("Floor1");
            ASSERT_GT(bench.run_until(15.0, [&] { return standing_open(rig, 1); }), 0.0);
          }
          const auto add = [&] {
            return bench.add(box("load", {0, 0, height(rig) + 0.21}, {0.4, 0.4, 0.4}, load));
          };
          physics::ModelId id;
          if (!comes) id = add();
          bench.run(3.0);
          rig.command(up ? "Floor1" : "Floor0");
          bench.run_until(8.0, [&] { return rig.mode() == (up ? "UP" : "DOWN"); });
          bench.run(wait);
          // What appears above a cabin that sinks with v lands on it with 2 v.
          const double lands = 2.0 * std::abs(rig.at("lift").velocity) + 0.05;
          if (comes) {
            add();
          } else {
            bench.world.remove(id);
          }
          double fastest = 0.0;
          const double took = bench.run_until(30.0, [&] {
            fastest = std::max(fastest, std::abs(rig.at("lift").velocity));
            return standing_open(rig, up ? 1 : 0);
          });
          EXPECT_GT(took, 0.0);
          EXPECT_LT(fastest, !up && comes ? std::max(1.2, lands) : 1.2);
          bench.run(1.0);
          EXPECT_NEAR(rig.state().get<double>("load"), comes ? load : 0.0, 0.01 * load + 0.5);
        }
      }
    }
  }
}

}  // namespace
}  // namespace angen::test
