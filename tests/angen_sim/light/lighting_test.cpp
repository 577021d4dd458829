// Measurements with rooms, shadows, switched lamps and changes.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/random.h"
#include "rooms.h"

namespace angen::light::testing {
namespace {

TEST(Lighting, DarkWithoutLamps) {
  Room room;
  room.lighting.remove(room.lamp);
  const Sample sample = measure(room.lighting, room.sensor);
  EXPECT_EQ(sample.illuminance, 0.0);
  EXPECT_EQ(sample.color, Eigen::Vector3f(0, 0, 0));
}

TEST(Lighting, DarkWhenSwitchedOff) {
  Room room;
  room.lighting.set_level(room.lamp, 0.0);
  EXPECT_EQ(lux(room.lighting, room.sensor), 0.0);
}

TEST(Lighting, DimmingIsLinearToTheBit) {
  Room room;
  Probe probe;
  const double full = room.lighting.measure(probe, room.sensor).illuminance;
  ASSERT_GT(full, 10.0);
  for (const double level : {0.5, 0.1, 0.37, 2.0}) {
    room.lighting.set_level(room.lamp, level);
    EXPECT_EQ(room.lighting.measure(probe, room.sensor).illuminance, level * full);
  }
}

TEST(Lighting, ProbeRemembersWithTheSameBits) {
  Room room;
  const LampId other = room.lighting.add(point_lamp(Vec3(1, 3, 1), 300.0), 0.0);
  Probe probe;
  expect_same_bits(room.lighting.measure(probe, room.sensor), measure(room.lighting, room.sensor));
  room.lighting.set_level(other, 0.6);
  expect_same_bits(room.lighting.measure(probe, room.sensor), measure(room.lighting, room.sensor));
  room.lighting.set_level(room.lamp, 0.0);
  expect_same_bits(room.lighting.measure(probe, room.sensor), measure(room.lighting, room.sensor));
}

/// Two closed rooms with moving things, and a lamp in each.
struct ClosedRooms {
  ClosedRooms() {
    add_room(scene, Vec3(0, 0, 0), Vec3(4, 4, 2.6), gray(0.7F));
    add_room(scene, Vec3(4.2, 0, 0), Vec3(8.2, 4, 2.6), gray(0.5F));
    for (int i = 0; i < 6; ++i) movers.push_back(add_mover(i % 3 == 0));
    scene.commit();
    for (const double x : {2.0, 6.2}) {
      lamps.push_back(lighting.add(point_lamp(Vec3(x, 2, 2.2), 800.0), 1.0));
    }
  }
  rays::ShapeId add_mover(bool anchored) {
    Shape box;
    box.type = Shape::Type::kBox;
    box.size = Vec3(0.3, 0.4, 0.9);
    const auto mobility = anchored ? rays::Mobility::kAnchored : rays::Mobility::kMoving;
    return scene.add(box, somewhere(), mobility, gray(0.4F));
  }
  Pose somewhere() {
    const double x = rng.uniform(), y = rng.uniform(), yaw = rng.uniform();
    return {Vec3(0.4 + 7.4 * x, 0.4 + 3.2 * y, 0.5), from_rpy(0, 0, 6.0 * yaw)};
  }

  Rng rng{1, hash_bytes("rooms"), 0};
  rays::Scene scene;
  Lighting lighting{scene};
  std::vector<rays::ShapeId> movers;
  std::vector<LampId> lamps;
};

TEST(Lighting, WhatMovesOutsideOfTheReachOfAProbeIsInNoWayOfItsLight) {
  ClosedRooms rooms;
  const Pose places[] = {facing(Vec3(0.05, 1.0, 2.0), Vec3::UnitX()),
                         facing(Vec3(6.0, 3.9, 1.0), -Vec3::UnitY())};
  Probe probes[2];
  int still_count = 0;
  for (int turn = 0; turn < 60; ++turn) {
    const rays::ShapeId moved = rooms.movers[rooms.rng.next() % rooms.movers.size()];
    const Eigen::AlignedBox3d before = rooms.scene.bounds(moved);
    rooms.scene.move(moved, rooms.somewhere());
    rooms.scene.commit();
    const Eigen::AlignedBox3d after = rooms.scene.bounds(moved);
    if (turn % 7 == 3) rooms.lighting.set_level(rooms.lamps[turn % 2], 0.25 * (turn % 4));
    for (int i = 0; i < 2; ++i) {
      const auto outside = [&](const auto& box) { return !probes[i].reach.intersects(box); };
      const bool still = turn > 0 && outside(before) && outside(after);
      still_count += still ? 1 : 0;
      const Sample sample = rooms.lighting.measure(probes[i], places[i], still);
      expect_same_bits(sample, measure(rooms.lighting, places[i]));
    }
  }
  EXPECT_GT(still_count, 20);
}

TEST(Lighting, NothingIsInTheWayOfLightThatDoesNotCome) {
  Room room;
  add_room(room.scene, Vec3(40, 0, 0), Vec3(44, 4, 2.6), gray(0.7F));
  add_box(room.scene, Vec3(42, 2, 0.5), Vec3(1, 1, 1), gray(0.5F), rays::Mobility::kMoving);
  room.scene.commit();
  const Pose far = facing(Vec3(40.05, 1.0, 2.0), Vec3::UnitX());
  Probe probe;
  EXPECT_EQ(room.lighting.measure(probe, far).illuminance, 0.0);
  EXPECT_EQ(probe.reach.diagonal().norm(), 0.0);
  room.lighting.add(point_lamp(Vec3(42, 2, 2.2), 800.0), 1.0);
  EXPECT_GT(room.lighting.measure(probe, far).illuminance, 10.0);
  EXPECT_TRUE(probe.reach.contains(Vec3(42, 2, 0.5)));
  EXPECT_FALSE(probe.reach.contains(Vec3(5, 2, 0.5)));
}

TEST(Lighting, ProbeForgetsAnotherWorld) {
  Room first, second;
  add_box(second.scene, Vec3(2, 2, 1), Vec3(1, 1, 1), gray(0.1F));
  second.scene.commit();
  add_box(first.scene, Vec3(2, 2, 1), Vec3(1, 1, 1), gray(0.9F));
  first.scene.commit();
  ASSERT_EQ(first.scene.revision(), second.scene.revision());
  Probe probe;
  first.lighting.measure(probe, first.sensor);
  expect_same_bits(second.lighting.measure(probe, first.sensor),
                   measure(second.lighting, first.sensor));
}

TEST(Lighting, OrderOfSwitchingLeavesNoTrace) {
  Room first, second;
  const LampId a = first.lighting.add(point_lamp(Vec3(1, 3, 1), 300.0), 1.0);
  const LampId b = second.lighting.add(point_lamp(Vec3(1, 3, 1), 300.0), 1.0);
  Probe probe_a, probe_b;
  first.lighting.set_level(a, 0.0);
  first.lighting.measure(probe_a, first.sensor);
  second.lighting.set_level(second.lamp, 0.0);
  second.lighting.measure(probe_b, second.sensor);
  first.lighting.set_level(a, 1.0);
  second.lighting.set_level(second.lamp, 1.0);
  EXPECT_EQ(b, a);
  expect_same_bits(first.lighting.measure(probe_a, first.sensor),
                   second.lighting.measure(probe_b, second.sensor));
}

TEST(Lighting, WhatComesToRestCountsAsStanding) {
  Room loose, fixed;
  const rays::ShapeId chest = add_box(loose.scene, Vec3(0.8, 3.2, 1.0), Vec3(1.2, 1.0, 2.0),
                                      gray(0.2F), rays::Mobility::kMoving);
  add_box(fixed.scene, Vec3(0.8, 3.2, 1.0), Vec3(1.2, 1.0, 2.0), gray(0.2F),
          rays::Mobility::kAnchored);
  for (Room* room : {&loose, &fixed}) room->scene.commit();
  const Sample moving = measure(loose.lighting, loose.sensor);
  loose.scene.set_anchored(chest, true);
  loose.scene.commit();
  expect_same_bits(measure(loose.lighting, loose.sensor), measure(fixed.lighting, fixed.sensor));
  loose.scene.set_anchored(chest, false);
  loose.scene.commit();
  expect_same_bits(measure(loose.lighting, loose.sensor), moving);
}

TEST(Lighting, ProbeFollowsEveryChange) {
  Room room;
  Probe probe;
  const auto again = [&] {
    const Sample sample = room.lighting.measure(probe, room.sensor);
    expect_same_bits(sample, measure(room.lighting, room.sensor));
    return sample.illuminance;
  };
  const double start = again();
  const rays::ShapeId table =
      add_box(room.scene, Vec3(2, 2, 0.7), Vec3(2, 2, 0.1), gray(0.1F), rays::Mobility::kMoving);
  room.scene.commit();
  const double with_table = again();
  EXPECT_NE(with_table, start);
  room.scene.move(table, {Vec3(1, 1, 0.7), Quat::Identity()});
  room.scene.commit();
  EXPECT_NE(again(), with_table);
  room.scene.remove(table);
  room.scene.commit();
  EXPECT_EQ(again(), start);
  room.lighting.move(room.lamp, {Vec3(1, 1, 2.2), Quat::Identity()});
  EXPECT_NE(again(), start);
  const LampId second = room.lighting.add(point_lamp(Vec3(3, 3, 1), 800.0), 1.0);
  const double two = again();
  room.lighting.remove(second);
  EXPECT_LT(again(), two);
  room.sensor.position.y() += 0.5;
  again();
}

TEST(Lighting, LampsAddUp) {
  Room room;
  const double one = lux(room.lighting, room.sensor);
  const LampId other = room.lighting.add(point_lamp(Vec3(3, 1, 1), 500.0), 1.0);
  const double both = lux(room.lighting, room.sensor);
  room.lighting.set_level(room.lamp, 0.0);
  EXPECT_EQ(one + lux(room.lighting, room.sensor), both);
  EXPECT_EQ(room.lighting.level(other), 1.0);
}

TEST(Lighting, StaleLampIsAnError) {
  Room room;
  room.lighting.remove(room.lamp);
  EXPECT_THROW(room.lighting.set_level(room.lamp, 1.0), std::out_of_range);
  EXPECT_THROW(room.lighting.level(room.lamp), std::out_of_range);
}

TEST(Lighting, ScreenBetweenLampAndSensorDarkens) {
  Room room;
  const double before = lux(room.lighting, room.sensor);
  add_box(room.scene, Vec3(1.0, 1.5, 2.1), Vec3(0.02, 1, 0.6), gray(0.7F), rays::Mobility::kMoving);
  room.scene.commit();
  const double behind = lux(room.lighting, room.sensor);
  EXPECT_LT(behind, 0.6 * before);
  EXPECT_GT(behind, 0.0);
}

TEST(Lighting, ShadowHasASoftEdge) {
  // A half-plane screen in the middle between lamp and point slides over the lamp's disc of 0.1 m.
  rays::Scene scene;
  const rays::ShapeId screen =
      add_box(scene, Vec3(0, 0, 1), Vec3(4, 4, 0.01), gray(0.0F), rays::Mobility::kMoving);
  Lighting lighting(scene);
  lighting.add(point_lamp(Vec3(0, 0, 2), 4 * M_PI * 1000), 1.0);
  double last = 0.0;
  int between = 0;
  for (int i = 0; i <= 40; ++i) {
    const double edge = 0.04 * (i / 20.0 - 1);  // m, of the screen
    scene.move(screen, {Vec3(edge + 2, 0, 1), Quat::Identity()});
    scene.commit();
    const double now = lux(lighting, facing(Vec3(0, 0, 0), Vec3::UnitZ()));
    EXPECT_GE(now, last);
    if (now > 0.0 && now < 249.0) ++between;
    last = now;
  }
  EXPECT_NEAR(last, 250.0, 1e-6);
  EXPECT_GT(between, 10);
}

TEST(Lighting, LampWithoutShadowsShinesThrough) {
  rays::Scene scene;
  add_box(scene, Vec3(0, 0, 1), Vec3(4, 4, 0.01), gray(0.0F));
  scene.commit();
  Lighting lighting(scene);
  Lamp lamp = point_lamp(Vec3(0, 0, 2), 4 * M_PI * 1000);
  lamp.cast_shadows = false;
  lighting.add(lamp, 1.0);
  EXPECT_NEAR(lux(lighting, facing(Vec3(0, 0, 0), Vec3::UnitZ())), 250.0, 1e-6);
}

TEST(Lighting, LampThatTouchesTheCeilingKeepsItsLight) {
  rays::Scene scene;
  add_box(scene, Vec3(0, 0, 2.06), Vec3(4, 4, 0.1), gray(0.0F));
  scene.commit();
  Lighting lighting(scene);
  lighting.add(point_lamp(Vec3(0, 0, 2), 4 * M_PI * 1000), 1.0);
  EXPECT_NEAR(lux(lighting, facing(Vec3(0, 0, 0), Vec3::UnitZ())), 250.0, 1e-6);
}

TEST(Lighting, RedWallTintsTheRoom) {
  rays::Scene scene;
  add_room(scene, Vec3(0, 0, 0), Vec3(4, 4, 2.6), gray(0.5F));
  scene.commit();
  Lighting lighting(scene);
  lighting.add(point_lamp(Vec3(1, 2, 2.4), 800.0), 1.0);  // above the view
  const Pose sensor = facing(Vec3(0.05, 2.0, 1.3), Vec3::UnitX());
  const Sample plain = measure(lighting, sensor);
  EXPECT_FLOAT_EQ(plain.color.x(), plain.color.y());
  add_box(scene, Vec3(3.98, 2, 1.3), Vec3(0.04, 4, 2.6), Eigen::Vector3f(0.5F, 0.05F, 0.05F));
  scene.commit();
  const Sample tinted = measure(lighting, sensor);
  EXPECT_GT(tinted.color.x(), 1.5F * tinted.color.y());
  EXPECT_LT(tinted.illuminance, plain.illuminance);
}

TEST(Lighting, ColouredLampKeepsItsLux) {
  Room room;
  room.lighting.remove(room.lamp);
  Lamp lamp = point_lamp(Vec3(2, 2, 2.2), 800.0);
  const LampId white = room.lighting.add(lamp, 1.0);
  const Sample plain = measure(room.lighting, room.sensor);
  room.lighting.remove(white);
  lamp.color = Eigen::Vector3f(2.0F, (1.0F - 2.0F * 0.2126F) / 0.7152F, 0.0F);  // luminance 1
  room.lighting.add(lamp, 1.0);
  const Sample warm = measure(room.lighting, room.sensor);
  EXPECT_NEAR(warm.illuminance, plain.illuminance, 1e-4 * plain.illuminance);
  EXPECT_GT(warm.color.x(), plain.color.x());
  EXPECT_EQ(warm.color.z(), 0.0F);
}

TEST(Lighting, ShutDoorKeepsTheNextRoomDark) {
  const TwoRooms rooms;
  EXPECT_GT(lux(rooms.lighting, rooms.lit_sensor), 20.0);
  EXPECT_LT(lux(rooms.lighting, rooms.dark_sensor), 0.01 * lux(rooms.lighting, rooms.lit_sensor));
}

TEST(Lighting, ADoorsWayLeavesNoTrace) {
  TwoRooms moved, fixed;
  const Pose side = facing(Vec3(4.2, 3.5, 1.5), Vec3::UnitX());
  lux(moved.lighting, moved.dark_sensor);
  moved.open();
  fixed.open();
  expect_same_bits(measure(moved.lighting, side), measure(fixed.lighting, side));
  moved.shut();
  const TwoRooms fresh;
  expect_same_bits(measure(moved.lighting, side), measure(fresh.lighting, side));
}

TEST(Lighting, WhatWasMeasuredBeforeLeavesNoTrace) {
  const TwoRooms queried, fresh;
  lux(queried.lighting, queried.lit_sensor);
  lux(queried.lighting, facing(Vec3(6, 3, 0.05), Vec3::UnitZ()));
  expect_same_bits(measure(queried.lighting, queried.dark_sensor),
                   measure(fresh.lighting, fresh.dark_sensor));
}

TEST(Lighting, OpenDoorLightsTheNextRoom) {
  TwoRooms rooms;
  const double shut = lux(rooms.lighting, rooms.dark_sensor);
  rooms.open();
  const double open = lux(rooms.lighting, rooms.dark_sensor);
  EXPECT_GT(open, 2 * shut);
  EXPECT_GT(open, 0.1);
  EXPECT_LT(open, lux(rooms.lighting, rooms.lit_sensor));
}

}  // namespace
}  // namespace angen::light::testing
