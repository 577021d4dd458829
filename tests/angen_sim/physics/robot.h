#pragma once

#include "models.h"

namespace angen::physics::testing {

/// A disc on two wheels of 3.5 cm and two sliding casters, as large as a TurtleBot's base. Its
/// joints 0 and 1 are the left and right wheel's; its frame is on the floor.
inline desc::Model robot_model(const std::string& name, const Vec3& at = Vec3::Zero()) {
  desc::Link base;
  base.name = "base";
  base.inertial = box_inertial(4.0, {0.3, 0.3, 0.1}, {{0, 0, 0.06}, Quat::Identity()});
  base.collisions.push_back(collision(round_shape(Shape::Type::kCylinder, 0.175, 0.08), 1.0,
                                      {{0, 0, 0.06}, Quat::Identity()}));
  for (const double x : {0.13, -0.13}) {
    base.collisions.push_back(collision(round_shape(Shape::Type::kSphere, 0.015), 0.0,
                                        {{x, 0, 0.015}, Quat::Identity()}));
    base.collisions.back().name = x > 0 ? "front_caster" : "back_caster";
  }
  std::vector<desc::Link> links{base};
  std::vector<desc::Joint> joints;
  for (const double side : {1.0, -1.0}) {
    desc::Link wheel;
    wheel.name = side > 0 ? "left_wheel" : "right_wheel";
    wheel.pose = {{0, 0.115 * side, 0.035}, from_rpy(-M_PI / 2, 0, 0)};
    wheel.inertial = box_inertial(0.1, {0.06, 0.06, 0.02});
    wheel.collisions.push_back(collision(round_shape(Shape::Type::kCylinder, 0.035, 0.02)));
    links.push_back(wheel);
    joints.push_back(joint_of(desc::Joint::Type::kRevolute, "base", wheel.name, Vec3::UnitY(),
                              wheel.pose.position));
  }
  desc::Model model = model_of(name, links, {at, Quat::Identity()});
  model.joints = joints;
  return model;
}

/// A cabin floor of 1.2 m on a vertical prismatic joint 0 ... 4 m; joint 0, upper face at z = 0.
inline desc::Model lift_model(const std::string& name, double mass = 10.0) {
  desc::Model model = model_of(
      name, {box_link("cabin", mass, {1.2, 1.2, 0.05}, {{0, 0, -0.025}, Quat::Identity()})});
  model.joints = {joint_of(desc::Joint::Type::kPrismatic, "world", "cabin")};
  model.joints[0].axes[0].lower = 0.0;
  model.joints[0].axes[0].upper = 4.0;
  return model;
}

/// A person: an upright capsule of 70 kg that slides on the floor.
inline desc::Model person_model(const std::string& name, const Vec3& at) {
  desc::Link body;
  body.name = "body";
  body.anatomy.upright = true;
  body.anatomy.side_stiffness = 25e3;
  body.inertial = box_inertial(70.0, {0.4, 0.3, 1.7}, {{0, 0, 0.85}, Quat::Identity()});
  body.collisions.push_back(collision(round_shape(Shape::Type::kCapsule, 0.25, 1.2), 0.0,
                                      {{0, 0, 0.85}, Quat::Identity()}));
  return model_of(name, {body}, {at, Quat::Identity()});
}

}  // namespace angen::physics::testing
