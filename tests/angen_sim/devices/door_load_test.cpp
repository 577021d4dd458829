// A door's drive against a load: a wind, a closer, a frame that leans.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

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

TEST(DoorLoad, ArrivesInTwiceTheTimeAgainstAnySteadyTorqueUpToAHundred) {
  for (const char* verb : {"Open", "Close"}) {
    const double against = std::string(verb) == "Open" ? 1.0 : -1.0;
    const double free = swing(verb, [](double, double) { return 0.0; }).took;
    ASSERT_GT(free, 0.0);
    for (const double torque : {-100.0, 6.0, 30.0, 100.0}) {
      const Swing found = swing(verb, [&](double, double) { return against * torque; });
      printf("%s against %.0f N m: %.2f s (%.2f s without), rests at %.4f rad\n", verb, torque,
             found.took, free, found.rests);
      EXPECT_GE(found.took, 0.0) << verb << torque;
      EXPECT_LT(found.took, 2.0 * free) << verb << torque;
    }
  }
}

TEST(DoorLoad, ArrivesAgainstALoadThatComesOnTheWay) {
  const double free = swing("Open", [](double, double) { return 0.0; }).took;
  for (const double torque : {8.0, 40.0, 80.0}) {
    const Swing found =
        swing("Open", [&](double, double time) { return time > 1.0 ? torque : 0.0; });
    printf("Open, after 1 s against %.0f N m: %.2f s, rests at %.4f rad\n", torque, found.took,
           found.rests);
    EXPECT_GT(found.took, 0.0) << torque;
    EXPECT_LT(found.took, 2.0 * free) << torque;
  }
}

// Such a load looks like an obstacle that holds the leaf: nothing was known of it at the start.
TEST(DoorLoad, ArrivesAgainstALoadThatComesWithTheCommand) {
  for (const char* verb : {"Open", "Close"}) {
    const double against = std::string(verb) == "Open" ? 1.0 : -1.0;
    const double free = swing(verb, [](double, double) { return 0.0; }).took;
    for (const double torque : {-100.0, 20.0, 60.0, 80.0, 100.0}) {
      const Swing found =
          swing(verb, [&](double, double time) { return time >= 0.0 ? against * torque : 0.0; });
      printf("%s, at once against %.0f N m: %.2f s, rests at %.4f rad\n", verb, torque, found.took,
             found.rests);
      EXPECT_GT(found.took, 0.0) << verb << torque;
      EXPECT_LT(found.took, 2.0 * free) << verb << torque;
    }
  }
}

TEST(DoorLoad, ArrivesAgainstAClosersSpringAndALeaningFrame) {
  const double free = swing("Open", [](double, double) { return 0.0; }).took;
  for (const double stiffness : {5.0, 20.0, 50.0}) {
    const Swing found = swing("Open", [&](double at, double) { return -stiffness * at; });
    EXPECT_GT(found.took, 0.0) << stiffness;
    EXPECT_LT(found.took, 2.0 * free) << stiffness;
  }
  for (const double weight : {-20.0, 20.0}) {  // N m, of a leaf on a frame that leans
    for (const char* verb : {"Open", "Close"}) {
      const Swing found =
          swing(verb, [&](double at, double) { return weight * std::sin(at + 0.3); });
      EXPECT_GT(found.took, 0.0) << verb << weight;
      EXPECT_LT(found.took, 2.0 * free) << verb << weight;
    }
  }
}

}  // namespace
}  // namespace angen::test
