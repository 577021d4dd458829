// Readings against converged values of a path tracer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "oracle.h"
#include "rooms.h"

namespace angen::light::testing {
namespace {

/// Within 2 % or 0.05 lx, plus the oracle's own error.
void expect_converged(const rays::Scene& scene, const Lighting& lighting, const Lamp& lamp,
                      const Pose& pose, int paths = 60'000, double share = 0.02,
                      double least = 0.05) {
  const Traced truth = trace(scene, lamp, pose, paths);
  const double allowed = std::max(least, share * truth.lux) + 2.0 * truth.deviation;
  EXPECT_NEAR(lux(lighting, pose), truth.lux, allowed) << "deviation " << truth.deviation;
}

struct Furnished {
  explicit Furnished(const Lamp& with) : lamp(with) {
    add_room(scene, Vec3(0, 0, 0), Vec3(4, 4, 2.6), gray(0.7F));
    add_box(scene, Vec3(2.6, 2.8, 0.7), Vec3(1.4, 0.8, 0.05), gray(0.4F));  // a table's top
    add_box(scene, Vec3(0.3, 3.2, 1.0), Vec3(0.6, 1.2, 2.0), gray(0.3F));   // a wardrobe
    Shape pillar;
    pillar.type = Shape::Type::kCylinder;
    pillar.radius = 0.2;
    pillar.length = 2.6;
    scene.add(pillar, {Vec3(1.2, 0.8, 1.3), Quat::Identity()}, rays::Mobility::kStatic, gray(0.6F));
    scene.commit();
    lighting.add(lamp, 1.0);
  }
  Lamp lamp;
  rays::Scene scene;
  Lighting lighting{scene};
};

Lamp window() {
  Lamp lamp = point_lamp(Vec3(0.01, 1.5, 1.5), 2000.0);
  lamp.type = Lamp::Type::kRectangle;
  lamp.direction = Vec3::UnitX();
  lamp.width = 1.4;  // along y
  lamp.height = 1.0;
  return lamp;
}

TEST(Converged, LitRoom) {
  const Furnished room(point_lamp(Vec3(2, 2, 2.2), 800.0));
  for (const Pose& at :
       {facing(Vec3(0.05, 1, 2), Vec3::UnitX()), facing(Vec3(3.5, 0.5, 0.05), Vec3::UnitZ()),
        facing(Vec3(2.6, 2.8, 0.3), Vec3::UnitZ()), facing(Vec3(1, 2, 2.5), -Vec3::UnitZ())}) {
    expect_converged(room.scene, room.lighting, room.lamp, at);
  }
}

/// Nine slats of 8 cm, 8 cm before a window; one step takes them all to an angle.
struct Blinds {
  explicit Blinds(double angle) {
    add_room(scene, Vec3(0, 0, 0), Vec3(5, 4, 2.6), gray(0.6F));
    add_box(scene, Vec3(2.5, 2.0, 0.72), Vec3(1.6, 0.8, 0.03), gray(0.5F));  // a desk
    for (int i = 0; i < 9; ++i) {
      const Vec3 at(0.125, 1.5, 1.0 + (i + 0.5) / 9.0);
      scene.add(box(Vec3(0.08, 1.6, 0.002)), {at, from_rpy(0, angle, 0)}, rays::Mobility::kStatic,
                gray(0.7F));
    }
    scene.commit();
    lighting.add(lamp, 1.0);
  }
  Lamp lamp = window();
  rays::Scene scene;
  Lighting lighting{scene};
};

TEST(Converged, DaylightThroughBlinds) {
  for (const double angle : {0.0, -M_PI / 4}) {
    const Blinds room(angle);
    for (const Pose& at :
         {facing(Vec3(1.5, 1.5, 2.599), -Vec3::UnitZ()), facing(Vec3(2.5, 2, 0.74), Vec3::UnitZ()),
          facing(Vec3(2.5, 2, 0.3), Vec3::UnitZ()), facing(Vec3(4, 3, 0.001), Vec3::UnitZ()),
          facing(Vec3(4.99, 2, 1.2), -Vec3::UnitX())}) {
      expect_converged(room.scene, room.lighting, room.lamp, at, 60'000, 0.03);
    }
  }
}

TEST(Converged, DaylightFromAWindow) {
  const Furnished room(window());
  for (const Pose& at :
       {facing(Vec3(3.9, 2, 2), -Vec3::UnitX()), facing(Vec3(2.5, 3, 1), Vec3::UnitX()),
        facing(Vec3(2.6, 2.8, 0.1), Vec3::UnitZ())}) {
    expect_converged(room.scene, room.lighting, room.lamp, at);
  }
}

TEST(Converged, LitThroughADoorway) {
  TwoRooms rooms;
  rooms.open();
  for (const Pose& at : {rooms.dark_sensor, facing(Vec3(6, 3, 0.05), Vec3::UnitZ()),
                         facing(Vec3(4.2, 3.5, 1.5), Vec3::UnitX())}) {
    expect_converged(rooms.scene, rooms.lighting, rooms.lamp, at, 100'000);
  }
  expect_converged(rooms.scene, rooms.lighting, rooms.lamp, rooms.lit_sensor);
}

TEST(Converged, ShutDoor) {
  const TwoRooms rooms;
  expect_converged(rooms.scene, rooms.lighting, rooms.lamp, rooms.dark_sensor);
  expect_converged(rooms.scene, rooms.lighting, rooms.lamp, rooms.lit_sensor);
}

TEST(Converged, Corridor) {
  rays::Scene scene;
  add_room(scene, Vec3(0, 0, 0), Vec3(12, 1.4, 2.6), gray(0.7F));
  scene.commit();
  Lighting lighting(scene);
  const Lamp lamp = point_lamp(Vec3(1, 0.7, 2.2), 800.0);
  lighting.add(lamp, 1.0);
  expect_converged(scene, lighting, lamp, facing(Vec3(11.9, 0.7, 2), -Vec3::UnitX()), 100'000);
  expect_converged(scene, lighting, lamp, facing(Vec3(6, 0.7, 1.5), Vec3::UnitX()), 100'000);
}

/// Shelves, a chest and a screen, static or loose at rest.
void expect_converged_among(rays::Mobility mobility, float albedo) {
  const Lamp lamp = point_lamp(Vec3(2, 2, 2.2), 800.0);
  rays::Scene scene;
  add_room(scene, Vec3(0, 0, 0), Vec3(4, 4, 2.6), gray(0.7F));
  add_box(scene, Vec3(0.3, 3.2, 1.0), Vec3(0.6, 1.2, 2.0), gray(albedo), mobility);
  add_box(scene, Vec3(3.75, 1.0, 0.9), Vec3(0.5, 1.6, 1.8), gray(albedo), mobility);
  add_box(scene, Vec3(1.5, 0.6, 0.8), Vec3(1.2, 0.03, 1.6), gray(albedo), mobility);
  add_box(scene, Vec3(2.6, 2.8, 0.7), Vec3(1.4, 0.8, 0.05), gray(albedo), mobility);
  scene.commit();
  Lighting lighting(scene);
  lighting.add(lamp, 1.0);
  for (const Pose& at :
       {facing(Vec3(0.05, 1, 2), Vec3::UnitX()), facing(Vec3(2.6, 2.8, 0.1), Vec3::UnitZ()),
        facing(Vec3(1.5, 0.3, 0.3), Vec3::UnitZ()), facing(Vec3(0.8, 3.9, 0.4), -Vec3::UnitY())}) {
    expect_converged(scene, lighting, lamp, at);
  }
}

TEST(Converged, FurnitureThatStands) { expect_converged_among(rays::Mobility::kStatic, 0.3F); }

TEST(Converged, LooseFurnitureAtRest) {
  expect_converged_among(rays::Mobility::kAnchored, 0.3F);
  expect_converged_among(rays::Mobility::kAnchored, 0.8F);
}

TEST(Converged, InTheGapBehindAChest) {
  const Lamp lamp = point_lamp(Vec3(2.4, 2.1, 2.35), 1000.0);
  for (const double turned : {0.0, 0.3}) {  // rad: the gap is 10 cm wide, or a wedge of 6 to 36 cm
    rays::Scene scene;
    add_room(scene, Vec3(0, 0, 0), Vec3(5, 4, 2.7), gray(0.6F));
    const rays::ShapeId chest = add_box(scene, Vec3(2.3, 0.3, 0.55), Vec3(1.0, 0.4, 1.1),
                                        gray(0.75F), rays::Mobility::kAnchored);
    if (turned > 0.0) scene.move(chest, {Vec3(2.3, 0.4, 0.55), from_rpy(0, 0, turned)});
    scene.commit();
    Lighting lighting(scene);
    lighting.add(lamp, 1.0);
    for (const Vec3& at : {Vec3(2.3, 0.05, 0.6), Vec3(2.5, 0.04, 0.9), Vec3(2.1, 0.02, 0.3)}) {
      expect_converged(scene, lighting, lamp, facing(at, Vec3::UnitY()), 200'000, 0.02);
    }
  }
}

TEST(Converged, DoorAjar) {
  TwoRooms rooms;
  for (const double angle : {0.15, 0.6, 1.2}) {
    const Eigen::Matrix3d turn = from_rpy(0, 0, angle).toRotationMatrix();
    const Vec3 hinge(4.05, 1.5, 1.005);
    rooms.scene.move(rooms.door, {hinge + turn * Vec3(0, 0.45, 0), from_rpy(0, 0, angle)});
    rooms.scene.commit();
    for (const Pose& at : {rooms.dark_sensor, facing(Vec3(6, 3, 0.05), Vec3::UnitZ()),
                           facing(Vec3(4.2, 3.9, 1.5), -Vec3::UnitY()),
                           facing(Vec3(4.2, 0.1, 0.3), Vec3::UnitY())}) {
      expect_converged(rooms.scene, rooms.lighting, rooms.lamp, at, 100'000);
    }
  }
}

/// A bathroom at x = 0 to 2.4 beside a corridor, and its door: ajar into either of them.
struct Bathroom {
  explicit Bathroom(double angle) {
    add_room(scene, Vec3(0, 0, 0), Vec3(4, 6, 2.5), gray(0.6F));
    add_box(scene, Vec3(1.2, 2.45, 1.25), Vec3(2.4, 0.1, 2.5), gray(0.7F));
    add_box(scene, Vec3(2.45, 0.4, 1.25), Vec3(0.1, 0.8, 2.5), gray(0.7F));
    add_box(scene, Vec3(2.45, 3.85, 1.25), Vec3(0.1, 4.3, 2.5), gray(0.7F));
    add_box(scene, Vec3(2.45, 1.25, 2.25), Vec3(0.1, 0.9, 0.5), gray(0.7F));
    const Quat turn = from_rpy(0, 0, angle);
    scene.add(box(Vec3(0.04, 0.89, 1.99)),
              {Vec3(2.45, 0.805, 1.005) + turn * Vec3(0, 0.445, 0), turn},
              rays::Mobility::kAnchored, gray(0.6F));
    scene.commit();
    lighting.add(lamp, 1.0);
  }
  Lamp lamp = point_lamp(Vec3(1.2, 1.2, 2.3), 1500.0);
  rays::Scene scene;
  Lighting lighting{scene};
};

// A part of a sill, a jamb or a lintel is lit on one side of the leaf and dark on the other.
TEST(Converged, BehindTheDoorOfABathroom) {
  struct Case {
    double angle;         // rad
    double share, least;  // of the light, and lx
  };
  for (const Case& with : {Case{0.0, 0.02, 0.05}, Case{0.09, 0.02, 0.05}, Case{-0.09, 0.02, 0.05},
                           Case{0.35, 0.02, 0.05}, Case{-0.35, 0.02, 0.05}}) {
    const Bathroom flat(with.angle);
    for (const Pose& at :
         {facing(Vec3(3.98, 1.2, 1.0), -Vec3::UnitX()), facing(Vec3(3.2, 1.2, 0.02), Vec3::UnitZ()),
          facing(Vec3(3.2, 0.02, 1.5), Vec3::UnitY()),
          facing(Vec3(3.2, 2.0, 2.48), -Vec3::UnitZ())}) {
      expect_converged(flat.scene, flat.lighting, flat.lamp, at, 200'000, with.share, with.least);
    }
  }
}

// Beside the leaf, cells of the floor are bright on one side and dark on the other, and so is the
// leaf along its width. From the corridor few directions meet the lit surfaces past the leaf.
TEST(Converged, PastADoorAjarBySomeDegrees) {
  for (const double angle : {0.15, 0.2}) {
    const Bathroom flat(angle);
    for (const Pose& at :
         {facing(Vec3(3.98, 1.2, 1.0), -Vec3::UnitX()),
          facing(Vec3(3.2, 2.0, 2.48), -Vec3::UnitZ()),
          facing(Vec3(3.98, 3.0, 1.5), -Vec3::UnitX()), facing(Vec3(3.4, 1.8, 0.03), Vec3::UnitZ()),
          facing(Vec3(3.95, 2.2, 0.6), -Vec3::UnitX())}) {
      expect_converged(flat.scene, flat.lighting, flat.lamp, at, 400'000);
    }
  }
}

TEST(Converged, PersonInTheRoom) {
  Furnished room(point_lamp(Vec3(2, 2, 2.2), 800.0));
  const rays::ShapeId person = add_box(room.scene, Vec3(0, 0, 0.85), Vec3(0.3, 0.5, 1.7),
                                       gray(0.4F), rays::Mobility::kMoving);
  for (const Vec3& place : {Vec3(1.2, 1.6, 0.85), Vec3(2.1, 2.0, 0.85), Vec3(1.0, 2.6, 0.85)}) {
    room.scene.move(person, {place, Quat::Identity()});
    room.scene.commit();
    expect_converged(room.scene, room.lighting, room.lamp, facing(Vec3(0.05, 1, 2), Vec3::UnitX()));
    expect_converged(room.scene, room.lighting, room.lamp,
                     facing(Vec3(3.5, 0.5, 0.05), Vec3::UnitZ()));
  }
}

}  // namespace
}  // namespace angen::light::testing
