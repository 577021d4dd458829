// Light over time: when lamps and moved shapes are taken over, and the readings meanwhile.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "core/random.h"
#include "rooms.h"

namespace angen::light::testing {
namespace {

constexpr Nanoseconds kTick = kSecond / 1000;

/// Ticks of 1 ms, as the simulation takes them.
struct Ticks {
  Nanoseconds now = 0;
  void advance(Lighting& lighting) { lighting.advance(now += kTick); }
  void advance(Lighting& lighting, int count) {
    for (int i = 0; i < count; ++i) advance(lighting);
  }
};

TEST(TakeOver, ALampGivesAllOfItsLightATenthOfASecondAfterItWasSwitchedOn) {
  Room room;
  room.lighting.set_level(room.lamp, 0.0);
  room.lighting.keep_time();
  Probe probe;
  Ticks ticks;
  ticks.advance(room.lighting);
  room.lighting.set_level(room.lamp, 1.0);
  // A device may switch it after the start of the tick.
  EXPECT_EQ(room.lighting.measure(probe, room.sensor).illuminance, 0.0);
  EXPECT_EQ(*room.lighting.next(), 0);
  ticks.advance(room.lighting);
  EXPECT_EQ(*room.lighting.next(), ticks.now + kSecond / 10);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(room.lighting.measure(probe, room.sensor).illuminance, 0.0);
    ticks.advance(room.lighting);
  }
  for (const double level : {1.0, 0.0, 0.5}) {  // its light is known: at once
    room.lighting.set_level(room.lamp, level);
    Room fresh;
    fresh.lighting.set_level(fresh.lamp, level);
    expect_same_bits(room.lighting.measure(probe, room.sensor),
                     measure(fresh.lighting, room.sensor));
    EXPECT_FALSE(room.lighting.next());
    ticks.advance(room.lighting);
  }
}

TEST(TakeOver, LampsThatAreSwitchedOnOneAfterTheOtherShineOneAfterTheOther) {
  Room room;
  std::vector<LampId> lamps;
  for (const double x : {0.5, 1.5, 2.5}) {
    lamps.push_back(room.lighting.add(point_lamp(Vec3(x, 1.0, 2.0), 300.0), 0.0));
  }
  room.lighting.keep_time();
  Ticks ticks;
  std::vector<double> seen;
  for (int i = 0; i < 200; ++i) {
    if (i % 30 == 0 && i < 90) {
      room.lighting.set_level(lamps[static_cast<std::size_t>(i / 30)], 1.0);
    }
    ticks.advance(room.lighting);
    const double now = lux(room.lighting, room.sensor);
    if (seen.empty() || now != seen.back()) seen.push_back(now);
  }
  ASSERT_EQ(seen.size(), 4U);
  Room fresh;
  for (const double x : {0.5, 1.5, 2.5}) {
    fresh.lighting.add(point_lamp(Vec3(x, 1.0, 2.0), 300.0), 1.0);
  }
  EXPECT_EQ(seen.back(), lux(fresh.lighting, room.sensor));
}

/// The ticks after which the reading in the dark room is that of the open door.
TEST(TakeOver, ADoorIsTakenOverAFifthOfASecondAfterItsLastMotion) {
  TwoRooms rooms, fresh;
  fresh.open();
  const Sample open = measure(fresh.lighting, fresh.dark_sensor);
  rooms.lighting.keep_time();
  Probe probe;
  Ticks ticks;
  const double shut = rooms.lighting.measure(probe, rooms.dark_sensor).illuminance;
  for (int i = 0; i < 5; ++i) {  // intermediate places
    rooms.scene.move(rooms.door, {Vec3(4.3, 1.6, 1.005), from_rpy(0, 0, 0.3 * i)});
    rooms.scene.commit();
    ticks.advance(rooms.lighting);
  }
  rooms.open();
  ticks.advance(rooms.lighting);
  EXPECT_EQ(*rooms.lighting.next(), ticks.now + kSecond / 10);
  ticks.advance(rooms.lighting, 199);
  EXPECT_LT(rooms.lighting.measure(probe, rooms.dark_sensor).illuminance,
            shut + 0.5 * (open.illuminance - shut));
  ticks.advance(rooms.lighting);
  expect_same_bits(rooms.lighting.measure(probe, rooms.dark_sensor), open);
  EXPECT_FALSE(rooms.lighting.next());
}

TEST(TakeOver, WhatKeepsMovingIsTakenOverEveryFiveSeconds) {
  TwoRooms rooms;
  rooms.lighting.keep_time();
  Ticks ticks;
  std::uint64_t last = rooms.lighting.lit_revision();
  int taken = 0;
  for (int i = 0; i < 11000; ++i) {
    rooms.scene.move(rooms.door, {Vec3(4.3, 1.6, 1.005), from_rpy(0, 0, 1e-3 * (i % 1000))});
    rooms.scene.commit();
    ticks.advance(rooms.lighting);
    taken += std::exchange(last, rooms.lighting.lit_revision()) != last ? 1 : 0;
  }
  EXPECT_EQ(taken, 2);
}

/// Lamps are switched and dimmed, and a door opens and shuts, at random times. When the door's last
/// place is taken over, each reading is the old or the new value.
TEST(TakeOver, NoReadingIsAMixture) {
  TwoRooms rooms;
  std::vector<LampId> lamps{rooms.lamp_id};
  std::vector<double> levels(6, 0.0);
  levels[0] = 1.0;
  const auto add_lamps = [](Lighting& lighting, const std::vector<double>& at) {
    std::vector<LampId> ids;
    for (std::size_t i = 1; i < at.size(); ++i) {
      const double x = 0.7 + 1.3 * static_cast<double>(i);
      ids.push_back(lighting.add(point_lamp(Vec3(x, 3.0, 2.2), 400.0), at[i]));
    }
    return ids;
  };
  for (const LampId lamp : add_lamps(rooms.lighting, levels)) lamps.push_back(lamp);
  const auto whole = [&](const Pose& door) {
    TwoRooms fresh;
    fresh.scene.move(fresh.door, door);
    fresh.scene.commit();
    fresh.lighting.set_level(fresh.lamp_id, levels[0]);
    add_lamps(fresh.lighting, levels);
    return measure(fresh.lighting, fresh.dark_sensor);
  };
  Rng rng(1, hash_bytes("take over"), 0);
  rooms.lighting.keep_time();
  Probe probe;
  Ticks ticks;
  double angle = 0.0, turn = 0.0;  // rad, and in each tick
  int still = 1000, switched_at = -1000, lit_at = -1000, compared = 0, awaited = 0;
  bool settled = false;  // all is taken over
  Sample before = rooms.lighting.measure(probe, rooms.dark_sensor);
  for (int i = 0; i < 6000; ++i) {
    if (rng.next() % 400 == 0) turn = rng.next() % 3 != 0 ? 0.0 : angle > 0.7 ? -5e-3 : 5e-3;
    const double next = std::min(1.5, std::max(0.0, angle + turn));
    still = next != angle ? 0 : still + 1;
    angle = next;
    const Pose door{Vec3(4.05, 1.5, 1.005) + from_rpy(0, 0, -angle) * Vec3(0, 0.45, 0),
                    from_rpy(0, 0, -angle)};
    rooms.scene.move(rooms.door, door);
    rooms.scene.commit();
    if (i > switched_at + 101 && rng.next() % 40 == 0) {
      const std::size_t which = rng.next() % lamps.size();
      const double level = rng.next() % 3 == 0 ? 0.0 : 0.25 * static_cast<double>(rng.next() % 5);
      switched_at = i;
      if (levels[which] == 0.0 && level > 0.0) lit_at = i;
      levels[which] = level;
      rooms.lighting.set_level(lamps[which], level);
    }
    ticks.advance(rooms.lighting);
    const bool was_settled = std::exchange(settled, still >= 200 && i >= lit_at + 100);
    const Sample now = rooms.lighting.measure(probe, rooms.dark_sensor);
    SCOPED_TRACE(i);
    if (settled && (!was_settled || i == switched_at)) {
      expect_same_bits(now, whole(door));
      ++compared;
    } else if (settled) {
      expect_same_bits(now, before);
    } else if (still > 200 && was_settled && now.illuminance != before.illuminance) {
      expect_same_bits(now, whole(door));  // a lamp whose light is known
    } else if (still > 200 && i > lit_at + 1) {
      expect_same_bits(now, before);
      ++awaited;
    }
    before = now;
  }
  EXPECT_GT(compared, 15);
  EXPECT_GT(awaited, 100);
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
  rooms.lighting.keep_time();
  Probe probe;
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
    ticks.advance(rooms.lighting);
    beside(rooms, i);
    if (i % 10 == 0) readings.push_back(rooms.lighting.measure(probe, rooms.dark_sensor));
  }
  return readings;
}

TEST(TakeOver, AnotherReaderChangesNoReading) {
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

/// The other lamp is lit at 20: until then all of its light was found, or a part.
TEST(TakeOver, LookingAheadChangesNoReading) {
  const auto alone = readings_while_things_change([](TwoRooms&, int) {});
  for (const int wait : {2000, 0}) {  // ms
    int begun = 0;
    const auto ahead = readings_while_things_change([&](TwoRooms& rooms, int i) {
      if (rooms.lighting.may_look_ahead()) {
        rooms.lighting.look_ahead();
        ++begun;
      }
      if (i == 18) std::this_thread::sleep_for(std::chrono::milliseconds(wait));
    });
    EXPECT_GT(begun, 0);
    ASSERT_EQ(alone.size(), ahead.size());
    for (std::size_t i = 0; i < alone.size(); ++i) expect_same_bits(alone[i], ahead[i]);
  }
}

TEST(TakeOver, WhatWasFoundAheadIsOfTheShapesThatAreThereWhenALampIsLit) {
  TwoRooms rooms, fresh;
  fresh.open();
  rooms.lighting.set_level(rooms.lamp_id, 0.0);
  rooms.lighting.keep_time();
  Ticks ticks;
  rooms.scene.move(rooms.door, {Vec3(4.3, 1.6, 1.005), from_rpy(0, 0, 0.7)});
  rooms.scene.commit();
  ASSERT_TRUE(rooms.lighting.may_look_ahead());
  rooms.lighting.look_ahead();
  EXPECT_FALSE(rooms.lighting.may_look_ahead());
  std::this_thread::sleep_for(std::chrono::seconds(1));
  rooms.open();
  ticks.advance(rooms.lighting);
  rooms.lighting.set_level(rooms.lamp_id, 1.0);
  ticks.advance(rooms.lighting, 101);
  expect_same_bits(measure(rooms.lighting, rooms.dark_sensor),
                   measure(fresh.lighting, fresh.dark_sensor));
}

TEST(TakeOver, ADoorThatMovedInTheDarkIsKnownWhenALampIsLit) {
  TwoRooms rooms, fresh;
  fresh.open();
  const Sample open = measure(fresh.lighting, fresh.dark_sensor);
  rooms.lighting.keep_time();
  Probe probe;
  Ticks ticks;
  rooms.lighting.measure(probe, rooms.dark_sensor);
  for (int lit_after = 1; lit_after < 300; lit_after += 70) {
    SCOPED_TRACE(lit_after);
    rooms.lighting.set_level(rooms.lamp_id, 0.0);
    rooms.shut();
    ticks.advance(rooms.lighting, 10);
    EXPECT_FALSE(rooms.lighting.next());
    rooms.open();
    for (int i = 0; i < lit_after; ++i) {
      ticks.advance(rooms.lighting);
      EXPECT_EQ(rooms.lighting.measure(probe, rooms.dark_sensor).illuminance, 0.0);
    }
    rooms.lighting.set_level(rooms.lamp_id, 1.0);
    ticks.advance(rooms.lighting, 101);
    expect_same_bits(rooms.lighting.measure(probe, rooms.dark_sensor), open);
  }
}

TEST(TakeOver, AWallThatComesAndGoesLeavesNoTrace) {
  TwoRooms rooms;
  Probe lit, dark;
  Ticks ticks;
  rooms.open();
  const Sample before = measure(rooms.lighting, rooms.dark_sensor);
  rooms.lighting.keep_time();
  const auto both = [&] {
    ticks.advance(rooms.lighting, 201);
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

/// A long board moves on a floor that stands turned, below a closet beside its way: patches of the
/// floor in it are made again, though nothing of the closet sees the board.
TEST(TakeOver, AMoveOnATurnedFloorIsAsIfFoundNow) {
  const Pose turned{{13.3, -5.1, 0.0}, from_rpy(0, 0, M_PI / 4)};
  const auto at = [&](const Vec3& place) { return turned * Pose{place, Quat::Identity()}; };
  const Pose shut = turned * Pose{{0, 0, 1.05}, from_rpy(0, 0, -M_PI / 4)};
  const Pose open = turned * Pose{{0, 0, 1.05}, from_rpy(0, 0, M_PI / 4)};
  const Vec3 closet(4.0, -4.0, 1.3);
  const auto fill = [&](rays::Scene& scene, const Pose& board) {
    const auto put = [&](const Vec3& center, const Vec3& size) {
      scene.add(box(size), at(center), rays::Mobility::kStatic, gray(0.7F));
    };
    put({0, 0, -0.1}, {12, 12, 0.2});
    put({0, 0, 2.7}, {12, 12, 0.2});
    for (const double side : {-1.0, 1.0}) {
      put(closet + Vec3(0.55 * side, 0, 0), {0.1, 1.2, 2.6});
      put(closet + Vec3(0, 0.55 * side, 0), {1.2, 0.1, 2.6});
    }
    const rays::ShapeId added =
        scene.add(box({6.0, 0.04, 2.0}), board, rays::Mobility::kAnchored, gray(0.5F));
    scene.commit();
    return added;
  };
  const Lamp first = point_lamp(turned * Vec3(0, -1, 2.2), 800.0);
  const Lamp inside = point_lamp(turned * Vec3(closet.x(), closet.y(), 2.2), 800.0);
  const Pose sensor = at(Vec3(closet.x(), closet.y(), 1.0));
  rays::Scene scene, now;
  const rays::ShapeId board = fill(scene, shut);
  fill(now, open);
  Lighting lighting(scene), fresh(now);
  LampId lamp = lighting.add(inside, 1.0);
  lighting.add(first, 1.0);
  EXPECT_GT(lux(lighting, sensor), 0.0);
  scene.move(board, open);
  scene.commit();
  EXPECT_GT(lux(lighting, sensor), 0.0);
  lighting.remove(lamp);
  lighting.add(inside, 1.0);
  fresh.add(first, 1.0);
  fresh.add(inside, 1.0);
  expect_same_bits(measure(lighting, sensor), measure(fresh, sensor));
}

}  // namespace
}  // namespace angen::light::testing
