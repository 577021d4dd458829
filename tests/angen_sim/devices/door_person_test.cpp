#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "angen_sim/devices/doors.h"

namespace angen::test {
namespace {

constexpr double kSideStiffness = 25e3;  // N/m, chest and pelvis: ISO/TS 15066:2016, table A.3
constexpr double kPersonMass = 70.0;     // kg
constexpr double kStands = 150.0;        // N, with which a person holds their place or walks

struct Hit {
  double worst = 0.0;   // N
  double speed = 0.0;   // m/s, of the leaf and the person towards each other before the contact
  double spring = 0.0;  // N: speed times sqrt(k m), m the reduced mass at the contact
  double back = 0.0;    // m/s, the fastest that they parted
};

/// Runs until half a second after the leaf and the person touch. `walks`: the person's velocity.
Hit meet(Bench& bench, Rig& door, const Vec3& at, const Vec3& walks) {
  const physics::LinkId body = bench.world.links(bench.add(person(at)))[0];
  const double inertia = door.limits(door.joint("hinge")).inertia;
  Hit hit;
  double before = 0.0;
  // Their speed towards each other, and the distance of the point of the leaf from its hinge.
  const auto approach = [&] {
    const physics::LinkState state = bench.world.link(body);
    const Vec3 arm(state.pose.position.x(), state.pose.position.y(), 0.0);
    const Vec3 along(std::cos(angle(door)), std::sin(angle(door)), 0.0);
    const Vec3 across(-along.y(), along.x(), 0.0);
    const double side = arm.dot(across) > 0.0 ? 1.0 : -1.0;
    const double leaf = door.at("hinge").velocity * arm.dot(along);
    return std::pair(side * (leaf - state.linear_velocity.dot(across)), arm.dot(along));
  };
  bench.run_until(4.0, [&] {
    bench.world.drive(body, walks, 0.0, kStands);
    hit.worst = bench.contact_force("person", "door::leaf").norm();
    if (hit.worst > 0.0) return true;
    before = approach().first;
    return false;
  });
  const double arm = approach().second;
  const double mass = 1.0 / (arm * arm / inertia + 1.0 / kPersonMass);
  hit.speed = before;
  hit.spring = before * std::sqrt(kSideStiffness * mass);
  bench.run(0.5, [&] {
    bench.world.drive(body, walks, 0.0, kStands);
    hit.worst = std::max(hit.worst, bench.contact_force("person", "door::leaf").norm());
    hit.back = std::max(hit.back, -approach().first);
  });
  return hit;
}

// ISO/TS 15066: a chest yields by 1 m per 25 kN.
TEST(Door, MeetsAPersonAsASpringDoes) {
  struct Case {
    const char* what;
    double start;  // rad
    const char* command;
    Vec3 at, walks;
  };
  for (const Case& with : {
           Case{"closes onto a standing person", -1.57, "Close", {0.5, -0.55, 0.001}, {0, 0, 0}},
           Case{"opens onto a standing person", 0.0, "Open", {0.6, -0.55, 0.001}, {0, 0, 0}},
           Case{"closes onto one who walks", -1.57, "Close", {0.85, -0.6, 0.001}, {-0.7, 0, 0}},
           Case{"opens onto one who walks", 0.0, "Open", {0.6, -0.9, 0.001}, {0, 0.7, 0}},
       }) {
    Bench bench;
    bench.add(ground());
    DoorMeasures measures;
    measures.angle = with.start;
    Rig& door = add_door(bench, measures);
    bench.run(0.1);
    ASSERT_TRUE(door.command(with.command).accepted);
    const Hit hit = meet(bench, door, with.at, with.walks);
    printf("a leaf %s: %.2f m/s, %.0f N, a spring %.0f N, back at %.2f m/s\n", with.what, hit.speed,
           hit.worst, hit.spring, hit.back);
    ASSERT_GT(hit.speed, 0.2) << with.what;
    EXPECT_GT(hit.worst, 0.5 * hit.spring) << with.what;
    // A spring that something pushes besides: k x^2 / 2 = m v^2 / 2 + F x.
    EXPECT_LT(hit.worst, 1.15 * (kStands + std::hypot(kStands, hit.spring))) << with.what;
    EXPECT_LT(hit.back, 0.2) << with.what;
  }
}

}  // namespace
}  // namespace angen::test
