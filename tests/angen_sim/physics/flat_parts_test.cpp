#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "models.h"
#include "physics/touching.h"

namespace angen::physics::testing {
namespace {

desc::Model ground(const Shape& shape) { return static_shape("ground", shape, 0.3); }

desc::Model thing(const Shape& shape, const Pose& pose) {
  desc::Link link = box_link("link", 1.0, {0.2, 0.2, 0.2});
  link.collisions = {collision(shape, 0.3)};
  return model_of("thing", {link}, pose);
}

/// Pushes a thing over the ground for a second; where it is then, and how fast.
LinkState pushed(const desc::Model& floor, const Shape& shape, const Pose& pose, bool first) {
  TestWorld world;
  if (first) world.add(floor);
  const LinkId link = world.only_link(world.add(thing(shape, pose)));
  if (!first) world.add(floor);
  world.run(0.3);
  world.set_velocity(link, {0.5, 0.2, 0.0}, Vec3::Zero());
  world.run(0.7);
  return world.link(link);
}

// ODE's contacts with the triangles turn, brake and stop bodies that cross their edges.
TEST(FlatParts, SlideAndRollAsOnAPlane) {
  using Type = Shape::Type;
  const Quat lying = from_rpy(0.0, M_PI / 2.0, 0.3);
  const std::vector<std::pair<Shape, Quat>> things = {
      {box_shape({0.2, 0.15, 0.1}), from_rpy(0, 0, 0.3)},
      {round_shape(Type::kSphere, 0.1), Quat::Identity()},
      {round_shape(Type::kCylinder, 0.1, 0.05), lying},
      {round_shape(Type::kCylinder, 0.1, 0.05), Quat::Identity()},
      {round_shape(Type::kCapsule, 0.1, 0.1), lying}};
  for (std::size_t i = 0; i < things.size(); ++i) {
    for (const double cell : {1.0, 0.1, 0.04}) {
      for (const bool first : {true, false}) {
        SCOPED_TRACE(std::to_string(i) + " on cells of " + std::to_string(cell));
        const auto& [shape, turned] = things[i];
        const Pose start{{-0.413, -0.107, 0.1}, turned};
        const LinkState on_plane = pushed(ground(plane_shape()), shape, start, first);
        const LinkState on_mesh = pushed(ground(mesh_floor(cell, 1.0)), shape, start, first);
        EXPECT_GT(on_plane.pose.position.x(), -0.4);
        EXPECT_NEAR((on_mesh.pose.position - on_plane.pose.position).norm(), 0.0, 2e-3);
        EXPECT_LT(on_mesh.pose.rotation.angularDistance(on_plane.pose.rotation), 0.02);
      }
    }
  }
}

TEST(FlatParts, EndAtTheirBorder) {
  for (const auto& [x, falls] : {std::pair(0.95, false), std::pair(1.05, true)}) {
    TestWorld world;
    world.add(ground(mesh_floor(0.1, 1.0)));
    const LinkId link = world.only_link(
        world.add(thing(box_shape({0.3, 0.2, 0.1}), {{x, 0.013, 0.051}, Quat::Identity()})));
    world.run(1.0);
    EXPECT_EQ(world.link(link).pose.position.z() < -0.5, falls) << x;
  }
}

// A body that is partly below a table has its lower corners far below the plane of its top.
TEST(FlatParts, ATableIsMetAtItsEdge) {
  for (const double y : {0.0, 0.45}) {
    TestWorld world({}, Vec3::Zero());
    world.add(ground(mesh_box({1.0, 1.0, 0.03}, {0.0, 0.0, 0.715})));
    const LinkId link = world.only_link(
        world.add(thing(box_shape({0.3, 0.3, 1.2}), {{-0.8, y, 0.6}, Quat::Identity()})));
    world.set_velocity(link, {1.0, 0.0, 0.0}, Vec3::Zero());
    world.run(0.3);
    EXPECT_LT(world.link(link).pose.position.x(), -0.55) << y;
    EXPECT_LT(std::abs(world.link(link).linear_velocity.z()), 0.5) << y;
  }
}

// A wall on the floor, of the same mesh: its edges stop a moving body.
TEST(FlatParts, WallsStop) {
  TriangleMesh mesh = *mesh_floor(0.1, 1.0).mesh;
  const auto at = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& corner : {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(0, 1, 0.5), Vec3(0, -1, 0.5)}) {
    mesh.vertices.push_back(corner.cast<float>());
  }
  mesh.triangles.push_back({at, at + 2, at + 1});
  mesh.triangles.push_back({at, at + 3, at + 2});
  for (const Shape& solid : {box_shape({0.2, 0.2, 0.2}), round_shape(Shape::Type::kSphere, 0.1)}) {
    TestWorld world;
    world.add(ground(mesh_shape(mesh)));
    const LinkId link =
        world.only_link(world.add(thing(solid, {{-0.3, 0.013, 0.1}, Quat::Identity()})));
    world.run(0.1);
    world.set_velocity(link, {1.5, 0.0, 0.0}, Vec3::Zero());
    world.run(0.5);
    EXPECT_NEAR(world.link(link).pose.position.x(), -0.1, 0.03);
  }
}

}  // namespace
}  // namespace angen::physics::testing
