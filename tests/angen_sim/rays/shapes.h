#pragma once

#include <memory>

#include "core/random.h"
#include "rays/scene.h"

/// Shapes and one-ray casts that the tests of `rays` share.
namespace angen::rays::testing {

inline Shape box(double x, double y, double z) {
  Shape shape;
  shape.type = Shape::Type::kBox;
  shape.size = {x, y, z};
  return shape;
}

inline Shape round(Shape::Type type, double radius, double length = 0.0) {
  Shape shape;
  shape.type = type;
  shape.radius = radius;
  shape.length = length;
  return shape;
}

inline Shape plane() {
  Shape shape;
  shape.type = Shape::Type::kPlane;
  return shape;
}

/// An octahedron with its corners on the axes at `radius`.
inline Shape octahedron(float radius) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices = {{radius, 0, 0},  {-radius, 0, 0}, {0, radius, 0},
                    {0, -radius, 0}, {0, 0, radius},  {0, 0, -radius}};
  mesh->triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                     {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  Shape shape;
  shape.type = Shape::Type::kMesh;
  shape.mesh = mesh;
  return shape;
}

/// The triangles of a heightmap.
inline std::shared_ptr<const TriangleMesh> mesh_of(const HeightGrid& grid) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    for (std::uint32_t c = 0; c < grid.columns; ++c) mesh->vertices.push_back(grid.vertex(c, row));
  }
  for (std::uint32_t row = 0; row + 1 < grid.rows; ++row) {
    for (std::uint32_t column = 0; column + 1 < grid.columns; ++column) {
      const std::uint32_t a = row * grid.columns + column;
      mesh->triangles.push_back({a, a + grid.columns, a + 1});
      mesh->triangles.push_back({a + 1, a + grid.columns, a + grid.columns + 1});
    }
  }
  return mesh;
}

inline Pose at(double x, double y, double z) { return {Vec3(x, y, z), Quat::Identity()}; }
inline Pose at(double x, double y, double z, const Quat& rotation) {
  return {Vec3(x, y, z), rotation};
}

inline Vec3 random_point(Rng& rng, double half) {
  const double x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
  return half * (2 * Vec3(x, y, z) - Vec3::Ones());
}

inline Pose random_pose(Rng& rng, double half) {
  const Vec3 point = random_point(rng, half);
  const Vec3 angles = random_point(rng, 3.0);
  return {point, from_rpy(angles.x(), angles.y(), angles.z())};
}

/// One of each type but a plane, about a meter large; also an empty one.
inline Shape random_shape(Rng& rng) {
  const double a = 0.2 + rng.uniform(), b = 0.2 + rng.uniform(), c = 0.2 + rng.uniform();
  switch (rng.next() % 6) {
    case 0:
      return box(a, b, c);
    case 1:
      return round(Shape::Type::kSphere, a / 2);
    case 2:
      return round(Shape::Type::kCylinder, a / 2, b);
    case 3:
      return round(Shape::Type::kCapsule, a / 2, b);
    case 4:
      return Shape{};
    default:
      return octahedron(static_cast<float>(a));
  }
}

inline ShapeId add(Scene& scene, const Shape& shape, const Pose& pose = {},
                   Mobility mobility = Mobility::kStatic) {
  return scene.add(shape, pose, mobility, Eigen::Vector3f::Constant(0.5F));
}

inline Ray ray(const Vec3& origin, const Vec3& direction) {
  Ray r;
  r.origin = origin;
  r.direction = direction.normalized();
  return r;
}

inline Hit cast_one(const Scene& scene, const Ray& ray) {
  Hit hit;
  scene.cast(&ray, &hit, 1);
  return hit;
}

inline Hit cast_one(const Scene& scene, const Vec3& origin, const Vec3& direction) {
  return cast_one(scene, ray(origin, direction));
}

}  // namespace angen::rays::testing
