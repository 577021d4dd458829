#pragma once

#include "light/lighting.h"

/// Rooms of boxes and one-call measures that the tests of `light` share.
namespace angen::light::testing {

inline Shape box(const Vec3& size) {
  Shape shape;
  shape.type = Shape::Type::kBox;
  shape.size = size;
  return shape;
}

inline rays::ShapeId add_box(rays::Scene& scene, const Vec3& centre, const Vec3& size,
                             const Eigen::Vector3f& albedo,
                             rays::Mobility mobility = rays::Mobility::kStatic) {
  return scene.add(box(size), {centre, Quat::Identity()}, mobility, albedo);
}

inline Eigen::Vector3f gray(float albedo) { return Eigen::Vector3f::Constant(albedo); }

/// Six slabs 0.2 m thick around the room between two corners; they overlap at the edges.
inline void add_room(rays::Scene& scene, const Vec3& low, const Vec3& high,
                     const Eigen::Vector3f& albedo) {
  const Vec3 centre = (low + high) / 2;
  const Vec3 size = high - low + Vec3::Constant(0.4);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 slab = size;
    slab[axis] = 0.2;
    for (const double side : {-1.0, 1.0}) {
      Vec3 at = centre;
      at[axis] += side * ((high - low)[axis] / 2 + 0.1);
      add_box(scene, at, slab, albedo);
    }
  }
}

/// A place whose x axis, the normal of its plane, points along `normal`.
inline Pose facing(const Vec3& position, const Vec3& normal) {
  return {position, Quat::FromTwoVectors(Vec3::UnitX(), normal)};
}

inline Lamp point_lamp(const Vec3& position, double flux) {
  Lamp lamp;
  lamp.pose.position = position;
  lamp.luminous_flux = flux;
  return lamp;
}

inline Sample measure(const Lighting& lighting, const Pose& pose) {
  Probe probe;
  return lighting.measure(probe, pose);
}

inline double lux(const Lighting& lighting, const Pose& pose) {
  return measure(lighting, pose).illuminance;
}

}  // namespace angen::light::testing
