#include "sim/resting.h"

#include <gtest/gtest.h>

#include <limits>

namespace angen::sim {
namespace {

constexpr Nanoseconds kTick = kSecond / 1000;
constexpr Nanoseconds kForever = std::numeric_limits<Nanoseconds>::max();

Pose at(double x, double yaw = 0.0) { return {Vec3(x, 0, 0), from_rpy(0, 0, yaw)}; }

/// The tick in which the body comes to rest, or -1 within `ticks`.
int comes_to_rest(Resting& resting, int ticks, int from = 0) {
  int found = -1;
  for (int i = from; i < from + ticks; ++i) {
    resting.update(i * kTick, [&](Resting::Body) { found = i; });
    if (found >= 0) return found;
  }
  return found;
}

TEST(Resting, ABodyRestsFromTheStartUntilItMoves) {
  Resting resting;
  const Resting::Body body = resting.add(at(1.0));
  EXPECT_EQ(resting.next(), kForever);
  EXPECT_FALSE(resting.move(body, at(1.0001)));  // less than is noticed
  EXPECT_EQ(resting.next(), kForever);
  EXPECT_TRUE(resting.move(body, at(1.01)));
  EXPECT_NE(resting.next(), kForever);
  EXPECT_FALSE(resting.move(body, at(1.02)));  // known already
}

TEST(Resting, ItRestsAgainWhenItHasStoodStillForFiveSeconds) {
  Resting resting;
  const Resting::Body body = resting.add(at(1.0));
  resting.move(body, at(2.0));
  EXPECT_EQ(comes_to_rest(resting, 4000), -1);
  EXPECT_EQ(resting.next(), 5 * kSecond);
  resting.move(body, at(2.0, 0.1));
  EXPECT_EQ(comes_to_rest(resting, 10000, 4000), 9000);
  EXPECT_EQ(resting.next(), kForever);
}

TEST(Resting, CreepingAddsUp) {
  Resting resting;
  const Resting::Body body = resting.add(at(0.0));
  bool left = false;
  for (int i = 1; i <= 20; ++i) left = resting.move(body, at(5e-5 * i)) || left;
  EXPECT_TRUE(left);
}

TEST(Resting, ARemovedBodyIsNotWaitedForAndItsNumberIsGivenAgain) {
  Resting resting;
  const Resting::Body body = resting.add(at(0.0));
  resting.add_shape(body, {3, 0});
  EXPECT_EQ(resting.shapes(body).size(), 1U);
  resting.move(body, at(1.0));
  resting.remove(body);
  EXPECT_EQ(resting.next(), kForever);
  const Resting::Body next = resting.add(at(5.0));
  EXPECT_EQ(next, body);
  EXPECT_TRUE(resting.shapes(next).empty());
  EXPECT_FALSE(resting.move(next, at(5.0)));
}

TEST(Resting, TimeThatGoesBackIsNotWaitedFor) {
  Resting resting;
  const Resting::Body body = resting.add(at(0.0));
  resting.move(body, at(1.0));
  resting.update(100 * kSecond, [](Resting::Body) {});
  EXPECT_EQ(comes_to_rest(resting, 6000), 5000);
}

}  // namespace
}  // namespace angen::sim
