#pragma once

#include <gtest/gtest.h>

#include "light/lighting.h"

/// Rooms of boxes and one-call measures that the tests of `light` share.
namespace angen::light::testing {

inline Shape box(const Vec3& size) {
  Shape shape;
  shape.type = Shape::Type::kBox;
  shape.size = size;
  return shape;
}

inline rays::ShapeId add_box(rays::Scene& scene, const Vec3& center, const Vec3& size,
                             const Eigen::Vector3f& albedo,
                             rays::Mobility mobility = rays::Mobility::kStatic) {
  return scene.add(box(size), {center, Quat::Identity()}, mobility, albedo);
}

inline Eigen::Vector3f gray(float albedo) { return Eigen::Vector3f::Constant(albedo); }

/// Six slabs 0.2 m thick around the room between two corners; they overlap at the edges.
inline void add_room(rays::Scene& scene, const Vec3& low, const Vec3& high,
                     const Eigen::Vector3f& albedo) {
  const Vec3 center = (low + high) / 2;
  const Vec3 size = high - low + Vec3::Constant(0.4);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 slab = size;
    slab[axis] = 0.2;
    for (const double side : {-1.0, 1.0}) {
      Vec3 at = center;
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

/// Two rooms side by side with a doorway in the wall at x = 4 between them, and its door.
struct TwoRooms {
  TwoRooms() {
    add_room(scene, Vec3(0, 0, 0), Vec3(8.1, 4, 2.6), gray(0.7F));
    add_box(scene, Vec3(4.05, 0.75, 1.3), Vec3(0.1, 1.5, 2.6), gray(0.7F));
    add_box(scene, Vec3(4.05, 3.2, 1.3), Vec3(0.1, 1.6, 2.6), gray(0.7F));
    add_box(scene, Vec3(4.05, 1.95, 2.3), Vec3(0.1, 0.9, 0.6), gray(0.7F));
    // As real doors do, it leaves gaps: 5 mm at the sides, 10 mm at the floor.
    door = add_box(scene, Vec3(4.05, 1.95, 1.005), Vec3(0.04, 0.89, 1.99), gray(0.5F),
                   rays::Mobility::kAnchored);
    scene.commit();
    lamp_id = lighting.add(lamp, 1.0);
  }
  void open() {
    // Turned by a quarter about its hinge, into the dark room.
    scene.move(door, {Vec3(4.5, 1.5, 1.005), from_rpy(0, 0, M_PI / 2)});
    scene.commit();
  }
  void shut() {
    scene.move(door, {Vec3(4.05, 1.95, 1.005), Quat::Identity()});
    scene.commit();
  }
  Lamp lamp = point_lamp(Vec3(2, 2, 2.2), 800.0);
  LampId lamp_id;
  rays::Scene scene;
  Lighting lighting{scene};
  rays::ShapeId door;
  Pose lit_sensor = facing(Vec3(0.05, 1.0, 2.0), Vec3::UnitX());
  Pose dark_sensor = facing(Vec3(8.05, 1.0, 2.0), -Vec3::UnitX());
};

/// A white room 4 x 4 x 2.6 m with a lamp below the ceiling and a sensor high on the wall x = 0.
struct Room {
  Room() {
    add_room(scene, Vec3(0, 0, 0), Vec3(4, 4, 2.6), gray(0.7F));
    scene.commit();
    lamp = lighting.add(point_lamp(Vec3(2, 2, 2.2), 800.0), 1.0);
  }
  rays::Scene scene;
  Lighting lighting{scene};
  LampId lamp;
  Pose sensor = facing(Vec3(0.05, 1.0, 2.0), Vec3::UnitX());
};

inline void expect_same_bits(const Sample& a, const Sample& b) {
  EXPECT_EQ(a.illuminance, b.illuminance);
  EXPECT_EQ(a.color, b.color);
}

}  // namespace angen::light::testing
