// Estimated reflected light against measurements of sensors at the same places.
#include "light/reflected_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "rooms.h"

namespace angen::light::testing {
namespace {

constexpr double kIntensity = 800.0 / (4.0 * M_PI);  // cd

/// lx, in a room that has been measured before.
template <class AnyRoom>
double estimate(const AnyRoom& room, const Vec3& point, const Vec3& normal) {
  const auto visible = [&](const Eigen::Vector3f& from, const Eigen::Vector3f* to, int count) {
    std::uint32_t seen = 0;
    for (int i = 0; i < count; ++i) {
      const Vec3 way = (to[i] - from).cast<double>();
      const rays::Ray ray{from.cast<double>(), way.normalized(), 0.0, way.norm()};
      rays::Hit hit;
      room.scene.cast(&ray, &hit, 1);
      if (!hit.hit()) seen |= 1U << i;
    }
    return seen;
  };
  return ReflectedLookup(*room.lighting.reflected(), visible)
      .at(point.cast<float>(), normal.cast<float>())
      .x();
}

/// Direct lx from the room's lamp.
double direct(const Vec3& point, const Vec3& normal) {
  const Vec3 way = Vec3(2, 2, 2.2) - point;
  return kIntensity * std::max(0.0, way.dot(normal)) / std::pow(way.norm(), 3);
}

TEST(ReflectedLight, NothingWhereNothingIsKnown) {
  const auto visible = [](const Eigen::Vector3f&, const Eigen::Vector3f*, int) { return ~0U; };
  EXPECT_EQ(
      ReflectedLookup(ReflectedLight({}), visible).at({1.0F, 2.0F, 3.0F}, Eigen::Vector3f::UnitZ()),
      Eigen::Vector3f::Zero());
}

TEST(ReflectedLight, OnWallsItIsWhatASensorThereMeasures) {
  const Room room;
  double sum = 0.0, sum_of_errors = 0.0;
  for (const double u : {0.5, 1.3, 2.0, 2.7, 3.5}) {
    for (const double v : {0.3, 0.9, 1.5, 2.3}) {
      for (const auto& [point, normal] : {std::pair<Vec3, Vec3>{{0.0, u, v}, Vec3::UnitX()},
                                          {{u, 4.0, v}, -Vec3::UnitY()},
                                          {{u, 1.6 * v, 0.0}, Vec3::UnitZ()},
                                          {{u, 1.6 * v, 2.6}, -Vec3::UnitZ()}}) {
        const double measured =
            lux(room.lighting, facing(point + 0.002 * normal, normal)) - direct(point, normal);
        const double found = estimate(room, point, normal);
        EXPECT_NEAR(found, measured, 0.15 * measured) << point.transpose();
        sum += measured;
        sum_of_errors += std::abs(found - measured);
      }
    }
  }
  EXPECT_LT(sum_of_errors, 0.05 * sum);
}

TEST(ReflectedLight, InTheMiddleOfARoomItIsBetweenThatOfTheWalls) {
  const Room room;
  lux(room.lighting, room.sensor);
  const double middle = estimate(room, {2.0, 2.0, 1.2}, Vec3::UnitX());
  const double on_the_floor = estimate(room, {2.0, 2.0, 0.0}, Vec3::UnitZ());
  EXPECT_GT(middle, 0.5 * on_the_floor);
  EXPECT_LT(middle, 1.5 * on_the_floor);
}

TEST(ReflectedLight, AWallKeepsItOut) {
  TwoRooms rooms;
  const double lit = lux(rooms.lighting, rooms.lit_sensor);
  ASSERT_GT(lit, 10.0);
  for (const double x : {4.11, 4.6, 6.0}) {
    EXPECT_LT(estimate(rooms, {x, 0.8, 0.0}, Vec3::UnitZ()), 0.02 * lit) << x;
  }
  EXPECT_LT(estimate(rooms, {4.1, 0.8, 1.3}, Vec3::UnitX()), 0.02 * lit);
}

TEST(ReflectedLight, DimmingIsLinear) {
  Room room;
  lux(room.lighting, room.sensor);
  const double full = estimate(room, {2.0, 1.0, 0.0}, Vec3::UnitZ());
  ASSERT_GT(full, 10.0);
  room.lighting.set_level(room.lamp, 0.25);
  EXPECT_FLOAT_EQ(estimate(room, {2.0, 1.0, 0.0}, Vec3::UnitZ()), 0.25 * full);
  room.lighting.set_level(room.lamp, 0.0);
  EXPECT_EQ(estimate(room, {2.0, 1.0, 0.0}, Vec3::UnitZ()), 0.0);
}

/// A door opens, and patches near it are found again while pictures are made.
TEST(ReflectedLight, IsThatOfNowWhoeverQueriedBefore) {
  TwoRooms often;
  often.lighting.keep_time();
  often.open();
  std::shared_ptr<const ReflectedLight> known;
  int made = 0, tick = 0;
  for (const int until : {1, 60, 101, 103, 106, 112, 130, 200, 400}) {
    TwoRooms once;
    once.lighting.keep_time();
    once.open();
    for (int i = 1; i <= until; ++i) once.lighting.advance(i * kSecond / 1000);
    while (tick < until) {
      often.lighting.advance(++tick * kSecond / 1000);
      if (std::exchange(known, often.lighting.reflected()) != often.lighting.reflected()) ++made;
    }
    for (const Vec3& point : {Vec3(0.5, 0.5, 0.0), Vec3(2.0, 3.5, 0.0), Vec3(3.9, 2.0, 0.0)}) {
      EXPECT_EQ(estimate(often, point, Vec3::UnitZ()), estimate(once, point, Vec3::UnitZ()))
          << until;
    }
  }
  EXPECT_GT(made, 1);
  EXPECT_LT(made, 8);  // not in each tick in which patches are found
}

}  // namespace
}  // namespace angen::light::testing
