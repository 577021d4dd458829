#pragma once

#include <memory>

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

inline Pose at(double x, double y, double z) { return {Vec3(x, y, z), Quat::Identity()}; }
inline Pose at(double x, double y, double z, const Quat& rotation) {
  return {Vec3(x, y, z), rotation};
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
