// A door's drive against a load: a wind, a closer, a frame that leans.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "angen_sim/devices/models.h"
#include "angen_sim/devices/rig.h"

namespace angen::test {
namespace {

/// Torque about the hinge, N m, of an angle and the time since the command.
using Torque = std::function<double(double, double)>;

struct Swing {
  double took = -1.0;  // s, until it is within 20 mrad for good
  double rests = 0.0;  // rad, in the end
};

Swing swing(const char* verb, const Torque& load) {
  Bench bench;
  Rig& leaf = bench.add(door(), "libdoor_world_plugin.so", "door");
  const physics::JointId hinge = bench.world.joints(leaf.id()).at(1);
  const auto angle = [&] { return leaf.at("hinge").position; };
  const bool opens = std::string(verb) == "Open";
  if (!opens) {
    leaf.command("Open");
    bench.run(5.0);
  }
  const auto push = [&](double time) { bench.world.add_force(hinge, load(angle(), time)); };
  for (int i = 0; i < 500; ++i) {  // it is there before the command
    push(-1.0);
    bench.tick();
  }
  EXPECT_TRUE(leaf.command(verb).accepted);
  const double target = opens ? -1.57 : 0.0;
  Swing result;
  for (int i = 0; i < 10000; ++i) {
    push(1e-3 * i);
    bench.tick();
    if (std::abs(angle() - target) > 0.02) {
      result.took = -1.0;
    } else if (result.took < 0.0) {
      result.took = 1e-3 * i;
    }
  }
  result.rests = angle();
  return result;
}

double swing_free(const char* verb) {
  const double took = swing(verb, [](double, double) { return 0.0; }).took;
  EXPECT_GT(took, 0.0) << verb;
  return took;
}

/// Expects that it arrives after the load has begun; one that was there before may hold it there.
void expect_arrives(const char* verb, double free, const Torque& load, const std::string& what,
                    double begin = 0.0) {
  const Swing found = swing(verb, load);
  printf("%s against %s: %.2f s (%.2f s without), rests at %.4f rad\n", verb, what.c_str(),
         found.took, free, found.rests);
  EXPECT_GT(found.took, begin) << verb << " " << what;
  EXPECT_LT(found.took, 2.0 * free) << verb << " " << what;
}

// A load that comes with the command looks like an obstacle that holds the leaf: nothing was
// known of it at the start.
TEST(DoorLoad, ArrivesInTwiceTheTimeAgainstATorqueUpToAHundred) {
  const std::vector<std::pair<double, std::vector<double>>> loads = {
      {-1.0, {-100.0, 6.0, 30.0, 100.0}},        // s after the command, N m; steady,
      {0.0, {-100.0, 20.0, 60.0, 80.0, 100.0}},  // with the command,
      {1.0, {8.0, 40.0, 80.0}}};                 // on the way
  for (const char* verb : {"Open", "Close"}) {
    const bool opens = std::string(verb) == "Open";
    const double free = swing_free(verb);
    for (const auto& [begin, torques] : loads) {
      if (begin == 1.0 && !opens) continue;
      for (const double torque : torques) {
        const auto load = [&, begin = begin](double, double time) {
          return time < begin ? 0.0 : opens ? torque : -torque;
        };
        expect_arrives(verb, free, load,
                       std::to_string(torque) + " N m from " + std::to_string(begin) + " s on",
                       begin);
      }
    }
  }
}

TEST(DoorLoad, ArrivesAgainstAClosersSpringAndALeaningFrame) {
  const double free = swing_free("Open");
  for (const double stiffness : {5.0, 20.0, 50.0}) {
    expect_arrives(
        "Open", free, [&](double at, double) { return -stiffness * at; }, "a spring");
  }
  for (const double weight : {-20.0, 20.0}) {  // N m, of a leaf on a frame that leans
    for (const char* verb : {"Open", "Close"}) {
      expect_arrives(
          verb, free, [&](double at, double) { return weight * std::sin(at + 0.3); }, "its weight");
    }
  }
}

struct Trip {
  double took = -1.0;    // s, until it is within 20 mrad for good
  double rests = 0.0;    // rad, after 10 s
  double fastest = 0.0;  // rad/s
  double beyond = 0.0;   // rad, past its target
};

/// A leaf of other measures under a steady torque (N m), from an angle to another.
Trip trip(const DoorMeasures& measures, const Parameters& parameters, double from, double to,
          double torque, bool is_there_before) {
  Bench bench;
  Rig& leaf = bench.add(door(measures), "libdoor_world_plugin.so", "door", parameters);
  const physics::JointId hinge = bench.world.joints(leaf.id()).at(1);
  leaf.command("Set " + std::to_string(from));
  bench.run(6.0);
  if (is_there_before) bench.run(1.0, [&] { bench.world.add_force(hinge, torque); });
  EXPECT_TRUE(leaf.command("Set " + std::to_string(to)).accepted);
  Trip result;
  double time = 0.0;  // s
  bench.run(10.0, [&] {
    time += 1e-3;
    bench.world.add_force(hinge, torque);
    const JointView at = leaf.at("hinge");
    result.fastest = std::max(result.fastest, std::abs(at.velocity));
    const bool is_there = std::abs(at.position - to) < 0.02;
    if (!is_there || result.took < 0.0) result.took = is_there ? time : -1.0;
    result.beyond = std::max(result.beyond, (at.position - to) * (to > from ? 1.0 : -1.0));
  });
  result.rests = leaf.at("hinge").position;
  return result;
}

// A setpoint that starts from rest again before a leaf that runs ahead would drive it further.
TEST(DoorLoad, AHeavyLeafDoesNotRunAway) {
  DoorMeasures measures;
  measures.mass = 53.5;
  measures.width = 1.04;
  const double free = trip(measures, {}, -1.2, -0.7, 0.0, false).took;
  for (const double torque : {-43.6, -30.0, 43.6}) {
    const Trip found = trip(measures, {}, -1.2, -0.7, torque, false);
    printf("53.5 kg and %.1f N m: %.2f s (%.2f s without), %.2f rad/s at most, %.3f rad too far\n",
           torque, found.took, free, found.fastest, found.beyond);
    EXPECT_GT(found.took, 0.0) << torque;
    EXPECT_LT(found.took, 2.0 * free) << torque;
    EXPECT_LT(found.beyond, 0.2) << torque;
    EXPECT_NEAR(found.rests, -0.7, 0.003) << torque;
  }
}

struct Leaf {
  double mass, width;  // kg, m
};

// A heavy leaf would swing with the gains of a light one, and a short way leaves no time to.
TEST(DoorLoad, HeavyLeavesAndShortWaysTakeTwiceTheTimeAtMost) {
  struct Way {
    double to, torque;  // rad, N m
  };
  for (const Leaf& leaf : {Leaf{8.0, 0.74}, {20.0, 0.9}, {46.8, 1.28}, {66.6, 1.22}}) {
    DoorMeasures measures;
    measures.mass = leaf.mass;
    measures.width = leaf.width;
    for (const Way& way : {Way{-0.7, 69.0}, {-0.9, 69.0}, {-1.08, 40.0}}) {
      const double free = trip(measures, {}, -1.2, way.to, 0.0, false).took;
      ASSERT_GT(free, 0.0);
      for (const double torque : {-way.torque, way.torque}) {
        const Trip found = trip(measures, {}, -1.2, way.to, torque, false);
        SCOPED_TRACE(testing::Message()
                     << leaf.mass << " kg, to " << way.to << " rad, " << torque << " N m");
        printf("%.1f kg, %.2f rad under %.0f N m: %.2f s (%.2f s without), %.3f rad too far\n",
               leaf.mass, way.to + 1.2, torque, found.took, free, found.beyond);
        EXPECT_GT(found.took, 0.0);
        EXPECT_LT(found.took, 2.0 * free);
      }
    }
  }
}

// A held joint trembles: its friction has no direction that the load could be found from.
TEST(DoorLoad, FrictionDoesNotHoldALeafOffItsTarget) {
  DoorMeasures measures;
  measures.mass = 38.9;
  measures.width = 1.08;
  measures.friction = 3.0;
  measures.damping = 0.0;
  for (const double torque : {-18.0, 0.0, 12.0, 18.0}) {
    const Trip found = trip(measures, {{"max_velocity", "1"}}, -0.65, -0.1, torque, true);
    printf("3 N m of friction and %.0f N m: rests at %.4f rad\n", torque, found.rests);
    EXPECT_NEAR(found.rests, -0.1, 0.02) << torque;
  }
}

}  // namespace
}  // namespace angen::test
