// Light that is computed in parts over ticks, and the readings meanwhile.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "rooms.h"

namespace angen::light::testing {
namespace {

/// Ticks of 1 ms.
struct Ticks {
  Nanoseconds now = 0;
  void advance(Lighting& lighting) { lighting.advance(now += kSecond / 1000); }
  /// Returns how many ticks it took until nothing was left to do.
  int work_off(Lighting& lighting) {
    int count = 0;
    for (; lighting.busy() && count < 20000; ++count) advance(lighting);
    EXPECT_FALSE(lighting.busy());
    return count;
  }
};

TEST(Lighting, InPartsItHasTheSameBits) {
  Room whole, parts;
  for (Room* room : {&whole, &parts}) room->lighting.add(point_lamp(Vec3(1, 3, 1), 300.0), 0.5);
  Probe probe;
  parts.lighting.prepare();
  EXPECT_GT(Ticks().work_off(parts.lighting), 10);
  expect_same_bits(parts.lighting.measure(probe, parts.sensor),
                   measure(whole.lighting, whole.sensor));
}

TEST(Lighting, AChangeMeanwhileLeavesNoTrace) {
  Room whole, parts;
  Probe probe;
  Ticks ticks;
  parts.lighting.prepare();
  for (int i = 0; i < 5; ++i) ticks.advance(parts.lighting);
  EXPECT_TRUE(parts.lighting.busy());
  for (Room* room : {&parts, &whole}) {
    add_box(room->scene, Vec3(1, 1, 0.5), Vec3(1, 1, 1), gray(0.2F));
    room->lighting.move(room->lamp, {Vec3(1, 2, 2.2), Quat::Identity()});
    room->scene.commit();
  }
  ticks.work_off(parts.lighting);
  expect_same_bits(parts.lighting.measure(probe, parts.sensor),
                   measure(whole.lighting, whole.sensor));
}

TEST(Lighting, WhatIsSwitchedOffMeanwhileIsNotWaitedFor) {
  Room room;
  Probe probe;
  room.lighting.prepare();
  EXPECT_TRUE(room.lighting.busy());
  room.lighting.set_level(room.lamp, 0.0);
  Ticks().advance(room.lighting);
  EXPECT_FALSE(room.lighting.busy());
  EXPECT_EQ(room.lighting.measure(probe, room.sensor).illuminance, 0.0);
}

TEST(Lighting, AMeasurementMeanwhileLeavesNoTrace) {
  Room whole, parts;
  Probe probe;
  Ticks ticks;
  parts.lighting.prepare();
  for (int i = 0; i < 5; ++i) ticks.advance(parts.lighting);
  parts.lighting.set_level(parts.lamp, 0.0);
  for (Room* room : {&parts, &whole}) {
    add_box(room->scene, Vec3(1, 1, 0.5), Vec3(1, 1, 1), gray(0.2F));
    room->scene.commit();
  }
  EXPECT_EQ(parts.lighting.measure(probe, parts.sensor).illuminance, 0.0);  // follows the change
  parts.lighting.set_level(parts.lamp, 1.0);
  ticks.work_off(parts.lighting);
  expect_same_bits(parts.lighting.measure(probe, parts.sensor),
                   measure(whole.lighting, whole.sensor));
}

TEST(Lighting, ALampIsSeenWhenItsLightIsKnownWhoeverMeasures) {
  Room watched, alone;
  Probe probes[2];
  int seen_after[2] = {0, 0};
  for (Room* room : {&watched, &alone}) {
    const std::size_t i = room == &alone ? 1 : 0;
    probes[i].ahead = true;
    room->lighting.set_level(room->lamp, 0.0);
    room->lighting.pace();
    room->lighting.measure(probes[i], room->sensor);
    room->lighting.set_level(room->lamp, 1.0);
    EXPECT_EQ(room->lighting.measure(probes[i], room->sensor).illuminance, 0.0);
    Ticks ticks;
    for (; room->lighting.busy() && seen_after[i] < 1000; ++seen_after[i]) {
      ticks.advance(room->lighting);
      if (room == &alone) continue;
      room->lighting.measure(probes[i], room->sensor);
      lux(room->lighting, facing(Vec3(2, 1, 0.5), Vec3::UnitZ()));
    }
  }
  EXPECT_GT(seen_after[0], 2);
  EXPECT_EQ(seen_after[0], seen_after[1]);
  const Sample seen = alone.lighting.measure(probes[1], alone.sensor);
  EXPECT_GT(seen.illuminance, 10.0);
  expect_same_bits(watched.lighting.measure(probes[0], watched.sensor), seen);
  expect_same_bits(measure(Room().lighting, alone.sensor), seen);
}

/// Until it is solved, light that is reflected more than once is missing.
TEST(Lighting, ALampThatIsLitForTheFirstTimeIsSeenInTheNextTickAndWholeWhenItIsSolved) {
  Room room, bare;
  bare.lighting.remove(bare.lamp);
  Probe probe;
  probe.ahead = true;
  room.lighting.set_level(room.lamp, 0.0);
  room.lighting.pace();
  room.lighting.measure(probe, room.sensor);
  room.lighting.set_level(room.lamp, 1.0);
  Ticks ticks;
  ticks.advance(room.lighting);
  ASSERT_TRUE(room.lighting.busy());
  room.lighting.begin_tick();
  const double first = room.lighting.measure(probe, room.sensor).illuminance;
  ticks.work_off(room.lighting);
  room.lighting.begin_tick();
  const double whole = room.lighting.measure(probe, room.sensor).illuminance;
  EXPECT_GT(first, 0.5 * whole);
  EXPECT_LT(first, 0.98 * whole);
}

/// In a scene that is too large to be solved in one tick, lit lamps are solved as new ones are.
TEST(Lighting, LightThatCostsTooMuchToLoadIsFoundInTheTicksAfter) {
  Room room;
  Probe probe;
  probe.ahead = true;
  room.lighting.pace(1000);
  const double first = room.lighting.measure(probe, room.sensor).illuminance;
  Ticks ticks;
  ticks.advance(room.lighting);
  ASSERT_TRUE(room.lighting.busy());
  ticks.work_off(room.lighting);
  room.lighting.begin_tick();
  const Sample whole = room.lighting.measure(probe, room.sensor);
  EXPECT_GT(first, 0.5 * whole.illuminance);
  EXPECT_LT(first, 0.98 * whole.illuminance);
  expect_same_bits(measure(Room().lighting, room.sensor), whole);
}

TEST(Lighting, OverTimeItTakesNoMoreThanItsShare) {
  TwoRooms rooms;
  rooms.lighting.pace();
  for (int i = 0; i < 120; ++i) {
    rooms.lighting.add(point_lamp(Vec3(0.5 + 0.06 * i, 2.0, 2.2), 400.0), 1.0);
  }
  EXPECT_GT(Ticks().work_off(rooms.lighting), 500);  // 254 without a share
}

/// Readings of one place every 10 ms while a lamp is lit for the first time, a door moves, a wall
/// is added and removed and a person walks; calls `beside` in each tick.
template <class F>
std::vector<Sample> readings_while_things_change(F&& beside) {
  TwoRooms rooms;
  const LampId other = rooms.lighting.add(point_lamp(Vec3(6, 1, 2.2), 400.0), 0.0);
  const rays::ShapeId person = add_box(rooms.scene, Vec3(6, 3, 0.85), Vec3(0.3, 0.5, 1.7),
                                       gray(0.4F), rays::Mobility::kMoving);
  rays::ShapeId wall;
  rooms.scene.commit();
  rooms.lighting.pace();
  Probe probe;
  probe.ahead = true;
  Ticks ticks;
  std::vector<Sample> readings;
  for (int i = 0; i < 700; ++i) {
    if (i == 20) rooms.lighting.set_level(other, 1.0);
    if (i >= 100 && i < 200) {
      const double angle = 0.01 * (i - 100);
      const Vec3 middle(0.45 * std::sin(angle), 0.45 * std::cos(angle), 1.005);
      rooms.scene.move(rooms.door, {Vec3(4.05, 1.5, 0) + middle, from_rpy(0, 0, -angle)});
    }
    if (i >= 150 && i < 300) {
      rooms.scene.move(person, {Vec3(6.0, 3.0 - 0.01 * (i - 150), 0.85), Quat::Identity()});
    }
    if (i == 400) wall = add_box(rooms.scene, Vec3(7, 2, 1.3), Vec3(0.1, 1.5, 2.6), gray(0.5F));
    if (i == 550) rooms.scene.remove(wall);
    rooms.scene.commit();
    rooms.lighting.begin_tick();
    ticks.advance(rooms.lighting);
    beside(rooms, i);
    if (i % 10 == 0) readings.push_back(rooms.lighting.measure(probe, rooms.dark_sensor));
  }
  return readings;
}

TEST(Lighting, AnotherReaderChangesNoReading) {
  const auto alone = readings_while_things_change([](TwoRooms&, int) {});
  const auto watched = readings_while_things_change([](TwoRooms& rooms, int i) {
    lux(rooms.lighting, facing(Vec3(0.5 + 0.01 * i, 1.0, 0.3), Vec3::UnitZ()));
    if (i % 3 == 0) lux(rooms.lighting, rooms.dark_sensor);
  });
  ASSERT_EQ(alone.size(), watched.size());
  int different = 0;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same_bits(alone[i], watched[i]);
    if (i > 0 && alone[i].illuminance != alone[i - 1].illuminance) ++different;
  }
  EXPECT_GT(different, 15);
}

/// Eight places in two rooms: a tick's budget is enough for some of them only.
TEST(Lighting, WhatExceedsATicksBudgetIsReadWhenItIsFoundAndThenExact) {
  TwoRooms rooms;
  const rays::ShapeId person = add_box(rooms.scene, Vec3(6, 3, 0.85), Vec3(0.3, 0.5, 1.7),
                                       gray(0.4F), rays::Mobility::kMoving);
  rooms.open();
  for (const double x : {1.0, 3.0, 6.0}) {
    rooms.lighting.add(point_lamp(Vec3(x, 3, 2.2), 400.0), 1.0);
  }
  rooms.lighting.pace();
  Probe probes[8];
  const auto place = [](int i) { return facing(Vec3(0.5 + i, 1.0, 0.3), Vec3::UnitZ()); };
  const auto read = [&](int i) { return rooms.lighting.measure(probes[i], place(i)); };
  std::vector<double> before;
  for (int i = 0; i < 8; ++i) {
    probes[i].ahead = true;
    before.push_back(read(i).illuminance);
    EXPECT_EQ(before.back(), lux(rooms.lighting, place(i)));  // the first is exact
  }
  Ticks ticks;
  ticks.advance(rooms.lighting);
  ticks.work_off(rooms.lighting);
  rooms.scene.move(person, {Vec3(4.0, 2.5, 0.85), Quat::Identity()});
  rooms.scene.commit();
  rooms.lighting.begin_tick();
  int unchanged = 0, changed = 0;
  for (int i = 0; i < 8; ++i) {
    const double now = read(i).illuminance;
    EXPECT_GT(now, 0.0);
    ++(now == before[i] ? unchanged : changed);
  }
  EXPECT_GT(unchanged, 0);
  EXPECT_GT(changed, 0);
  EXPECT_LT(ticks.work_off(rooms.lighting), 20);
  rooms.lighting.begin_tick();
  for (int i = 0; i < 8; ++i) expect_same_bits(read(i), measure(rooms.lighting, place(i)));
}

TEST(Lighting, ALampIsLitAgainInTheSameTickAsFarAsItIsKnown) {
  Room room;
  room.lighting.pace();
  Probe probe;
  probe.ahead = true;
  const double lit = room.lighting.measure(probe, room.sensor).illuminance;
  Ticks ticks;
  room.lighting.set_level(room.lamp, 0.0);
  ticks.work_off(room.lighting);
  EXPECT_EQ(room.lighting.measure(probe, room.sensor).illuminance, 0.0);
  room.lighting.set_level(room.lamp, 0.5);
  EXPECT_EQ(room.lighting.measure(probe, room.sensor).illuminance, 0.5 * lit);
}

TEST(Lighting, AProbeThatIsExpectedFindsItsLightAheadOfItsQuery) {
  Room room, fresh;
  Probe probe;
  Ticks ticks;
  room.lighting.expect(probe, room.sensor);
  EXPECT_TRUE(room.lighting.busy());
  EXPECT_GT(ticks.work_off(room.lighting), 5);
  room.lighting.pace();
  room.lighting.begin_tick();
  expect_same_bits(room.lighting.measure(probe, room.sensor),
                   measure(fresh.lighting, fresh.sensor));
}

TEST(Lighting, PacedLightEndsWhereItIsFoundAtOnce) {
  TwoRooms rooms;
  Probe probe;
  Ticks ticks;
  rooms.lighting.pace();
  const double shut = rooms.lighting.measure(probe, rooms.dark_sensor).illuminance;
  rooms.open();
  for (int i = 0; i < 5; ++i) {  // intermediate places
    rooms.scene.move(rooms.door, {Vec3(4.3, 1.6, 1.005), from_rpy(0, 0, 0.3 * i)});
    rooms.scene.commit();
    ticks.advance(rooms.lighting);
    rooms.lighting.measure(probe, rooms.dark_sensor);
  }
  rooms.open();
  ticks.advance(rooms.lighting);
  EXPECT_GT(ticks.work_off(rooms.lighting), 50);  // it waits for the door to rest
  const Sample open = rooms.lighting.measure(probe, rooms.dark_sensor);
  EXPECT_GT(open.illuminance, 2 * shut);
  TwoRooms fresh;
  fresh.open();
  expect_same_bits(open, measure(fresh.lighting, fresh.dark_sensor));
}

/// Patches are updated when the door has rested for 0.1 s, which takes some ticks.
TEST(Lighting, ADoorThatMovesWhilePatchesAreFoundAnewEndsWhereItIsFoundAtOnce) {
  TwoRooms rooms, fresh;
  const Sample shut = measure(fresh.lighting, fresh.dark_sensor);
  rooms.lighting.pace();
  Probe probe;
  Ticks ticks;
  for (int delay = 98; delay < 125; ++delay) {
    SCOPED_TRACE(delay);
    rooms.open();
    for (int i = 0; i < delay; ++i) {
      rooms.lighting.measure(probe, rooms.dark_sensor);
      ticks.advance(rooms.lighting);
    }
    rooms.shut();
    rooms.lighting.measure(probe, rooms.dark_sensor);
    ticks.work_off(rooms.lighting);
    expect_same_bits(rooms.lighting.measure(probe, rooms.dark_sensor), shut);
  }
}

/// In the dark, motion is checked each 10 ms only, and at once when a lamp is lit.
TEST(Lighting, ADoorThatMovedInTheDarkIsKnownWhenALampIsLit) {
  TwoRooms rooms, fresh;
  fresh.open();
  const Sample open = measure(fresh.lighting, fresh.dark_sensor);
  rooms.lighting.pace();
  Probe probe;
  Ticks ticks;
  rooms.lighting.measure(probe, rooms.dark_sensor);
  for (int lit_after = 1; lit_after < 300; lit_after += 23) {
    SCOPED_TRACE(lit_after);
    rooms.lighting.set_level(rooms.lamp_id, 0.0);
    rooms.shut();
    ticks.work_off(rooms.lighting);
    rooms.open();
    for (int i = 0; i < lit_after; ++i) {
      ticks.advance(rooms.lighting);
      EXPECT_EQ(rooms.lighting.measure(probe, rooms.dark_sensor).illuminance, 0.0);
    }
    rooms.lighting.set_level(rooms.lamp_id, 1.0);
    ticks.advance(rooms.lighting);
    ticks.work_off(rooms.lighting);
    expect_same_bits(rooms.lighting.measure(probe, rooms.dark_sensor), open);
  }
}

TEST(Lighting, AWallThatComesAndGoesLeavesNoTrace) {
  TwoRooms rooms;
  Probe lit, dark;
  Ticks ticks;
  rooms.open();
  const Sample before = measure(rooms.lighting, rooms.dark_sensor);
  rooms.lighting.pace();
  const auto both = [&] {
    ticks.advance(rooms.lighting);
    ticks.work_off(rooms.lighting);
    rooms.lighting.measure(lit, rooms.lit_sensor);
    return rooms.lighting.measure(dark, rooms.dark_sensor);
  };
  both();
  const rays::ShapeId wall =
      add_box(rooms.scene, Vec3(3.9, 1.95, 1.3), Vec3(0.1, 1.5, 2.6), gray(0.5F));
  rooms.scene.commit();
  EXPECT_LT(both().illuminance, 0.2 * before.illuminance);
  rooms.scene.remove(wall);
  rooms.scene.commit();
  expect_same_bits(both(), before);
}

}  // namespace
}  // namespace angen::light::testing
