#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/time.h"
#include "desc/world.h"
#include "physics/world.h"

/// Small models and a world to try them in.
namespace angen::physics::testing {

inline const Vec3 kGravity(0.0, 0.0, -9.81);
constexpr double kStep = 1e-3;  // s

inline Shape box_shape(const Vec3& size) {
  Shape shape;
  shape.type = Shape::Type::kBox;
  shape.size = size;
  return shape;
}

inline Shape round_shape(Shape::Type type, double radius, double length = 0.0) {
  Shape shape;
  shape.type = type;
  shape.radius = radius;
  shape.length = length;
  return shape;
}

inline Shape plane_shape() {
  Shape shape;
  shape.type = Shape::Type::kPlane;
  return shape;
}

inline Shape mesh_shape(TriangleMesh mesh) {
  Shape shape;
  shape.type = Shape::Type::kMesh;
  shape.mesh = std::make_shared<TriangleMesh>(std::move(mesh));
  return shape;
}

/// A square of cells of `cell` m, with two triangles each, from -half to half at z = 0.
inline Shape mesh_floor(double cell, double half) {
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(std::lround(2.0 * half / cell));
  for (std::uint32_t y = 0; y <= count; ++y) {
    for (std::uint32_t x = 0; x <= count; ++x) {
      mesh.vertices.push_back(Vec3(cell * x - half, cell * y - half, 0.0).cast<float>());
      if (x == count || y == count) continue;
      const std::uint32_t at = y * (count + 1) + x;
      mesh.triangles.push_back({at, at + 1, at + count + 2});
      mesh.triangles.push_back({at, at + count + 2, at + count + 1});
    }
  }
  return mesh_shape(std::move(mesh));
}

/// A closed box of twelve triangles, outside counter-clockwise.
inline Shape mesh_box(const Vec3& size, const Vec3& middle = Vec3::Zero()) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5);
    mesh.vertices.emplace_back((middle + corner.cwiseProduct(size)).cast<float>());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh_shape(std::move(mesh));
}

inline desc::Collision collision(const Shape& shape, double mu = 1.0, const Pose& pose = {}) {
  desc::Collision c;
  c.name = "collision";
  c.shape = shape;
  c.pose = pose;
  c.friction.mu = mu;
  c.friction.mu2 = mu;
  return c;
}

inline desc::Inertial box_inertial(double mass, const Vec3& s, const Pose& pose = {}) {
  desc::Inertial inertial;
  inertial.mass = mass;
  inertial.pose = pose;
  inertial.moment = (mass / 12.0 *
                     Vec3(s.y() * s.y() + s.z() * s.z(), s.x() * s.x() + s.z() * s.z(),
                          s.x() * s.x() + s.y() * s.y()))
                        .asDiagonal();
  return inertial;
}

inline desc::Link box_link(const std::string& name, double mass, const Vec3& size,
                           const Pose& pose = {}, double mu = 1.0) {
  desc::Link link;
  link.name = name;
  link.pose = pose;
  link.inertial = box_inertial(mass, size);
  link.collisions.push_back(collision(box_shape(size), mu));
  return link;
}

/// A link of some mass that nothing can touch.
inline desc::Link ghost_link(const std::string& name, double mass, const Vec3& size,
                             const Pose& pose = {}) {
  desc::Link link = box_link(name, mass, size, pose);
  link.collisions.clear();
  return link;
}

inline desc::Model model_of(const std::string& name, std::vector<desc::Link> links,
                            const Pose& pose = {}) {
  desc::Model model;
  model.name = name;
  model.pose = pose;
  model.links = std::move(links);
  return model;
}

inline desc::Model box_model(const std::string& name, double mass, const Vec3& size,
                             const Vec3& at = Vec3::Zero(), double mu = 1.0) {
  return model_of(name, {box_link("link", mass, size, {}, mu)}, {at, Quat::Identity()});
}

inline desc::Model static_box(const std::string& name, const Vec3& size,
                              const Vec3& at = Vec3::Zero(), double mu = 1.0) {
  desc::Model model = box_model(name, 1.0, size, at, mu);
  model.is_static = true;
  return model;
}

inline desc::Model static_shape(const std::string& name, const Shape& shape, double mu = 1.0) {
  desc::Model model = static_box(name, {1, 1, 1});
  model.links[0].collisions = {collision(shape, mu)};
  return model;
}

/// A floor whose upper face is z = 0.
inline desc::Model floor_model(double mu = 1.0) {
  return static_box("floor", {20.0, 20.0, 0.2}, {0.0, 0.0, -0.1}, mu);
}

inline desc::Joint joint_of(desc::Joint::Type type, const std::string& parent,
                            const std::string& child, const Vec3& axis = Vec3::UnitZ(),
                            const Vec3& anchor = Vec3::Zero()) {
  desc::Joint joint;
  joint.name = child + "_joint";
  joint.type = type;
  joint.parent = parent;
  joint.child = child;
  joint.anchor = anchor;
  if (type == desc::Joint::Type::kRevolute || type == desc::Joint::Type::kPrismatic) {
    desc::JointAxis a;
    a.xyz = axis;
    joint.axes.push_back(a);
  }
  return joint;
}

/// A door leaf of 40 kg, 0.8 x 0.04 x 2 m, hinged at x = 0 about z, with a handle on each face and
/// a strip on top, all fixed to it.
inline desc::Model door_model(const std::string& name, const Vec3& at = Vec3::Zero()) {
  desc::Link base = ghost_link("base", 1.0, {0.1, 0.1, 0.1});
  desc::Link leaf = box_link("door", 40.0, {0.8, 0.04, 2.0}, {{0.4, 0.0, 1.01}, Quat::Identity()});
  desc::Link front =
      box_link("handle1", 0.2, {0.1, 0.04, 0.02}, {{0.75, 0.04, 1.0}, from_rpy(0.1, 0.2, 0.3)});
  desc::Link back =
      box_link("handle2", 0.2, {0.1, 0.04, 0.02}, {{0.75, -0.04, 1.0}, Quat::Identity()});
  desc::Link strip =
      box_link("strip", 0.1, {0.1, 0.03, 0.03}, {{0.7, 0.0, 2.03}, Quat::Identity()});
  desc::Model model = model_of(name, {base, leaf, front, back, strip}, {at, Quat::Identity()});
  using Type = desc::Joint::Type;
  model.joints = {
      joint_of(Type::kFixed, "world", "base"), joint_of(Type::kRevolute, "base", "door"),
      joint_of(Type::kFixed, "door", "handle1"), joint_of(Type::kFixed, "door", "handle2"),
      joint_of(Type::kFixed, "door", "strip")};
  model.joints[1].axes[0].lower = -1.57;
  model.joints[1].axes[0].upper = 0.001;
  return model;
}

/// A World that counts its own ticks.
class TestWorld : public World {
 public:
  explicit TestWorld(const desc::Physics& settings = {}, const Vec3& gravity = kGravity,
                     std::uint64_t seed = 1)
      : World(settings, gravity, seed), step_(to_seconds(settings.step)) {}

  void run(double seconds) {
    const auto n = static_cast<int>(std::lround(seconds / step_));
    for (int i = 0; i < n; ++i) step(tick_++);
  }
  LinkId only_link(ModelId model) const { return links(model).at(0); }

 private:
  double step_;
  std::int64_t tick_ = 0;
};

/// Sum of the forces on what `name` (a collision) touches takes, on `name` itself.
inline Vec3 force_on(const World& world, const std::string& name) {
  Vec3 sum = Vec3::Zero();
  for (const ContactPair& pair : world.contacts()) {
    for (const ContactPoint& point : pair.points) {
      if (pair.first == name) sum += point.force;
      if (pair.second == name) sum -= point.force;
    }
  }
  return sum;
}

/// Time of the n-th sign change of the position, interpolated; in s, by steps of 1 ms.
inline double crossing_time(TestWorld& world, JointId joint, int n) {
  const double step = 1e-3;
  double last = world.joint(joint).position;
  for (int i = 1;; ++i) {
    world.run(step);
    const double now = world.joint(joint).position;
    if ((now < 0) != (last < 0) && --n == 0) return (i - 1 + last / (last - now)) * step;
    last = now;
    if (i > 100000) return -1.0;
  }
}

}  // namespace angen::physics::testing
