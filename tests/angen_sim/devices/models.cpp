#include "angen_sim/devices/models.h"

namespace angen::test {

namespace {

desc::Collision box_collision(const std::string& name, const Vec3& at, const Vec3& size) {
  desc::Collision collision;
  collision.name = name;
  collision.pose.position = at;
  collision.shape.type = Shape::Type::kBox;
  collision.shape.size = size;
  return collision;
}

Eigen::Matrix3d box_moment(const Vec3& size, double mass) {
  const Vec3 sq = size.cwiseProduct(size);
  return (mass / 12.0 * Vec3(sq.y() + sq.z(), sq.x() + sq.z(), sq.x() + sq.y())).asDiagonal();
}

desc::Joint joint(const std::string& name, desc::Joint::Type type, const std::string& parent,
                  const std::string& child, const Vec3& axis, double lower, double upper) {
  desc::Joint made;
  made.name = name;
  made.type = type;
  made.parent = parent;
  made.child = child;
  made.axes.resize(1);
  made.axes[0].xyz = axis;
  made.axes[0].lower = lower;
  made.axes[0].upper = upper;
  return made;
}

void add_leaf(desc::Model& model, const std::string& name, const std::string& parent, double side,
              const Vec3& at) {
  model.links.push_back(box_link(name, at, {0.44, 0.04, 2.0}, 15.0));
  model.joints.push_back(
      joint(name, desc::Joint::Type::kPrismatic, parent, name, side * Vec3::UnitX(), 0.0, 0.42));
}

}  // namespace

desc::Link box_link(const std::string& name, const Vec3& at, const Vec3& size, double mass) {
  desc::Link link;
  link.name = name;
  link.pose.position = at;
  link.inertial.mass = mass;
  link.inertial.moment = box_moment(size, mass);
  link.collisions.push_back(box_collision("collision", Vec3::Zero(), size));
  return link;
}

desc::Model box(const std::string& name, const Vec3& at, const Vec3& size, double mass) {
  desc::Model model;
  model.name = name;
  model.pose.position = at;
  model.is_static = mass == 0.0;
  model.links.push_back(box_link("body", Vec3::Zero(), size, mass == 0.0 ? 1.0 : mass));
  return model;
}

desc::Model ground(double z) { return box("ground", {0, 0, z - 0.5}, {40, 40, 1}); }

desc::Model door(const DoorMeasures& measures) {
  desc::Model model;
  model.name = "door";
  desc::Link base;
  base.name = "base";
  model.links.push_back(base);
  const Vec3 size(measures.width - 0.02, 0.04, 2.0);
  desc::Link leaf = box_link("leaf", Vec3::Zero(), size, measures.mass);
  leaf.inertial.pose.position = {measures.width / 2.0 + 0.01, 0.0, 1.01};
  leaf.collisions[0].pose = leaf.inertial.pose;
  model.links.push_back(leaf);
  model.joints.push_back(
      joint("fix", desc::Joint::Type::kFixed, "world", "base", Vec3::UnitZ(), 0, 0));
  model.joints.back().axes.clear();
  model.joints.push_back(
      joint("hinge", desc::Joint::Type::kRevolute, "base", "leaf", Vec3::UnitZ(), -1.57, 0.001));
  desc::JointAxis& hinge = model.joints.back().axes[0];
  hinge.damping = measures.damping;
  hinge.friction = measures.friction;
  hinge.initial_position = measures.angle;
  return model;
}

desc::Model elevator(double cabin_mass) {
  desc::Model model;
  model.name = "elevator";
  desc::Link base;
  base.name = "base";
  model.links.push_back(base);
  desc::Link cabin = box_link("cabin", Vec3::Zero(), {1.5, 1.5, 2.2}, cabin_mass);
  cabin.inertial.pose.position = {0, 0, 1.0};
  cabin.collisions = {box_collision("floor", {0, 0, -0.05}, {1.5, 1.5, 0.1}),
                      box_collision("back", {0, 0.75, 1.0}, {1.5, 0.05, 2.0}),
                      box_collision("left", {-0.75, 0, 1.0}, {0.05, 1.5, 2.0}),
                      box_collision("right", {0.75, 0, 1.0}, {0.05, 1.5, 2.0})};
  model.links.push_back(cabin);
  model.joints.push_back(
      joint("fix", desc::Joint::Type::kFixed, "world", "base", Vec3::UnitZ(), 0, 0));
  model.joints.back().axes.clear();
  model.joints.push_back(
      joint("lift", desc::Joint::Type::kPrismatic, "base", "cabin", Vec3::UnitZ(), 0.0, 4.0));
  add_leaf(model, "cabin_door_left", "cabin", -1.0, {-0.22, -0.72, 1.02});
  add_leaf(model, "cabin_door_right", "cabin", 1.0, {0.22, -0.72, 1.02});
  for (int floor = 0; floor < 2; ++floor) {
    const std::string name = "landing_door_" + std::to_string(floor);
    add_leaf(model, name + "_left", "base", -1.0, {-0.22, -0.82, 4.0 * floor + 1.02});
    add_leaf(model, name + "_right", "base", 1.0, {0.22, -0.82, 4.0 * floor + 1.02});
  }
  return model;
}

desc::Model robot(const Vec3& at) {
  desc::Model model;
  model.name = "robot";
  model.pose.position = at;
  desc::Link base = box_link("base", {0, 0, 0.1}, {0.3, 0.18, 0.1}, 5.9);
  for (const double side : {-1.0, 1.0}) {
    desc::Collision caster;
    caster.name = side < 0 ? "rear" : "front";
    caster.pose.position = {side * 0.12, 0, -0.085};
    caster.shape.type = Shape::Type::kSphere;
    caster.shape.radius = 0.015;
    caster.friction.mu = caster.friction.mu2 = 0.0;
    base.collisions.push_back(caster);
  }
  model.links.push_back(base);
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0 ? "left_wheel" : "right_wheel";
    desc::Link wheel;
    wheel.name = name;
    wheel.pose = {{0, side * 0.115, 0.035}, from_rpy(-M_PI / 2, 0, 0)};
    wheel.inertial.mass = 0.2;
    wheel.inertial.moment = Vec3(7e-5, 7e-5, 1.2e-4).asDiagonal();
    desc::Collision tyre;
    tyre.name = "collision";
    tyre.shape.type = Shape::Type::kCylinder;
    tyre.shape.radius = 0.035;
    tyre.shape.length = 0.02;
    wheel.collisions.push_back(tyre);
    model.links.push_back(wheel);
    desc::Joint axle = joint(name + "_joint", desc::Joint::Type::kRevolute, "base", name,
                             Vec3::UnitY(), -1e16, 1e16);
    axle.anchor = {0, side * 0.115, 0.035};
    model.joints.push_back(axle);
  }
  return model;
}

desc::Model person(const Vec3& at) {
  desc::Model model;
  model.name = "person";
  model.pose.position = at;
  desc::Link body = box_link("body", Vec3::Zero(), {0.5, 0.5, 1.75}, 70.0);
  body.anatomy.upright = true;
  body.anatomy.side_stiffness = 25e3;
  body.inertial.pose.position.z() = body.collisions[0].pose.position.z() = 0.875;
  Shape& shape = body.collisions[0].shape;
  shape.type = Shape::Type::kCapsule;
  shape.radius = 0.25;
  shape.length = 1.25;
  body.collisions[0].friction.mu = body.collisions[0].friction.mu2 = 0.0;
  model.links.push_back(body);
  return model;
}

}  // namespace angen::test
