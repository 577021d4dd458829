#include <gtest/gtest.h>

#include <cmath>

#include "models.h"

namespace angen::physics::testing {
namespace {

constexpr double kRadius = 0.1;
constexpr double kTorque = 5.0;  // N m, Gazebo's default

struct WheelAt {
  double x, y;
};

/// A base on wheels of some width and, where there are two, on a caster without friction. Joint i
/// is that of wheel i.
desc::Model cart(const std::vector<WheelAt>& wheels, double width, double mu) {
  desc::Link base;
  base.name = "base";
  base.inertial = box_inertial(10.0, {0.3, 0.3, 0.1}, {{-0.02, 0, kRadius}, Quat::Identity()});
  if (wheels.size() == 2) {
    base.collisions.push_back(collision(round_shape(Shape::Type::kSphere, 0.05), 0.0,
                                        {{-0.15, 0, 0.05}, Quat::Identity()}));
  }
  std::vector<desc::Link> links{base};
  std::vector<desc::Joint> joints;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    desc::Link wheel;
    wheel.name = "wheel" + std::to_string(i);
    wheel.pose = {{wheels[i].x, wheels[i].y, kRadius}, from_rpy(-M_PI / 2, 0, 0)};
    wheel.inertial = box_inertial(1.0, {2 * kRadius, 2 * kRadius, 0.05});
    wheel.collisions.push_back(collision(round_shape(Shape::Type::kCylinder, kRadius, width), mu));
    links.push_back(wheel);
    joints.push_back(joint_of(desc::Joint::Type::kRevolute, "base", wheel.name, Vec3::UnitY(),
                              wheel.pose.position));
  }
  desc::Model model = model_of("cart", links);
  model.joints = joints;
  return model;
}

double yaw_of(const Quat& q) { return to_rpy(q).z(); }

/// The angles by which the base and its right and left wheels turn in a second, rad.
struct Turn {
  double base = 0.0, right = 0.0, left = 0.0;
};

Turn turn_on_the_spot(const std::vector<WheelAt>& wheels, double width, double mu,
                      const desc::Model& floor) {
  TestWorld world;
  world.add(floor);
  const ModelId id = world.add(cart(wheels, width, mu));
  world.run(0.3);
  const auto joints = world.joints(id);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    world.set_motor(joints[i], wheels[i].y > 0 ? -1.5 : 1.5, kTorque);
  }
  world.run(0.5);
  const auto now = [&] {
    Turn at{yaw_of(world.link(world.links(id)[0]).pose.rotation)};
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      (wheels[i].y > 0 ? at.left : at.right) = world.joint(joints[i]).position;
    }
    return at;
  };
  const Turn start = now();
  world.run(1.0);
  const Turn end = now();
  return {std::remainder(end.base - start.base, 2 * M_PI), end.right - start.right,
          end.left - start.left};
}

desc::Model plane_floor(double mu) {
  desc::Model model = floor_model(mu);
  model.links[0].collisions[0].shape = plane_shape();
  model.links[0].collisions[0].pose.position.z() += 0.1;
  return model;
}

// Rigid discs that roll: the yaw rate is the difference of the rims' speeds over their distance.
TEST(WheelLine, ARobotOfTwoWheelsTurnsAsDiscsDoAtAnyWidth) {
  constexpr double kApart = 0.4;  // m
  const std::vector<WheelAt> wheels = {{0.0, kApart / 2}, {0.0, -kApart / 2}};
  for (const double mu : {0.5, 1.0, 1e14}) {
    for (const double width : {0.001, 0.05, 0.2}) {
      for (const desc::Model& floor : {plane_floor(mu), floor_model(mu)}) {
        const Turn turn = turn_on_the_spot(wheels, width, mu, floor);
        const double exact = (turn.right - turn.left) * kRadius / kApart;
        EXPECT_GT(exact, 0.7) << "the wheels turn at 1.5 rad/s";
        EXPECT_NEAR(turn.base / exact, 1.0, 0.005) << "width " << width << ", mu " << mu;
      }
    }
  }
}

// Four points that slide with one friction and one load: along and across forces are as the slips,
// and their torques add up to none, so yaw / (rim speed / half track) = b^2 / (b^2 + l^2).
TEST(WheelLine, ASkidSteeredRobotTurnsAsItsContactPointsSay) {
  for (const auto& [track, base] : {std::pair(0.6, 0.4), {0.5, 0.5}, {0.8, 0.2}}) {
    const double x = base / 2 - 0.02, y = track / 2;  // the load's middle is at x = -0.02
    const std::vector<WheelAt> wheels = {
        {x, y}, {x, -y}, {-base / 2 - 0.02, y}, {-base / 2 - 0.02, -y}};
    for (const double width : {0.02, 0.1}) {
      const Turn turn = turn_on_the_spot(wheels, width, 0.5, plane_floor(0.5));
      const double rolled = (turn.right - turn.left) * kRadius / track;
      const double exact = track * track / (track * track + base * base);
      EXPECT_NEAR(turn.base / rolled, exact, 0.02 * exact) << track << " " << base << " " << width;
    }
  }
}

// A load beside the middle, that a step of the speed makes slip: the force is that of both wheels'
// loads, so it does not matter how wide they are.
TEST(WheelLine, AWideWheelSlipsAsANarrowOneDoes) {
  std::vector<double> turned;
  for (const double width : {0.001, 0.05, 0.15}) {
    TestWorld world;
    world.add(plane_floor(1.0));
    desc::Model model = cart({{0.0, 0.2}, {0.0, -0.2}}, width, 1.0);
    model.links[0].inertial.pose.position.y() = 0.08;
    const ModelId id = world.add(model);
    world.run(0.5);
    for (const JointId joint : world.joints(id)) world.set_motor(joint, 3.0, kTorque);
    world.run(0.3);
    turned.push_back(yaw_of(world.link(world.links(id)[0]).pose.rotation));
  }
  EXPECT_LT(turned[0], -0.003);
  EXPECT_NEAR(turned[1], turned[0], 0.002);  // 2 mm a meter
  EXPECT_NEAR(turned[2], turned[0], 0.002);
}

// A roller with its load beside its middle stands on all of its width, though it is a wheel.
TEST(WheelLine, ADrumStandsOnItsWidth) {
  TestWorld world;
  world.add(plane_floor(1.0));
  desc::Model roller = cart({{0.0, 0.0}}, 0.6, 1.0);
  roller.links[0].inertial =
      box_inertial(2.0, {0.3, 0.3, 0.1}, {{0, 0.2, kRadius}, Quat::Identity()});
  const ModelId id = world.add(roller);
  world.run(1.0);
  const Vec3 up = world.link(world.links(id)[1]).pose.rotation * Vec3::UnitZ();
  EXPECT_LT(std::abs(up.z()), 5e-3);  // the layer of 1 mm at an end
  EXPECT_NEAR(force_on(world, "cart::wheel0::collision").z(), 3.0 * 9.81, 0.05);
}

}  // namespace
}  // namespace angen::physics::testing
