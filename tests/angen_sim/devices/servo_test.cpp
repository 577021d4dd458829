#include "devices/servo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace angen::devices {
namespace {

constexpr double kServoStep = 0.001;

/// A leaf on a hinge: inertia, viscous damping, dry friction; something may hold it.
struct Plant {
  double inertia = 5.4;   // kg m^2
  double damping = 1.0;   // N m s/rad
  double friction = 0.5;  // N m
  double position = 0.0;
  double velocity = 0.0;
  bool held = false;

  void step(double torque) {
    if (held) {
      velocity = 0.0;
      return;
    }
    const double driven = velocity + torque / (inertia + damping * kServoStep) * kServoStep -
                          damping * velocity / inertia * kServoStep;
    const double rubbed = friction / inertia * kServoStep;
    velocity = std::abs(driven) < rubbed ? 0.0 : driven - std::copysign(rubbed, driven);
    position += velocity * kServoStep;
  }
};

ServoSettings door_settings() {
  ServoSettings settings;
  settings.gains = {70.0, 200.0, 25.0, 100.0, -100.0, 120.0, -120.0};
  settings.max_velocity = 1.0;
  settings.max_acceleration = 2.0;
  settings.inertia = 5.4;
  settings.max_lag = 0.08;
  settings.arrive_error = 0.0015;
  settings.arrive_speed = 0.02;
  settings.stall_speed = 0.004;
  settings.near_error = 0.003;
  settings.load_rate = 11.0;
  return settings;
}

struct Loop {
  Plant plant;
  Servo servo{door_settings()};
  double torque = 0.0;
  double deepest = 0.0;
  bool was_blocked = false;

  void tick(double target) {
    torque = servo.update(target, plant.position, plant.velocity, kServoStep);
    plant.step(torque);
    deepest = std::min(deepest, plant.position);
    was_blocked = was_blocked || servo.blocked();
  }
  /// Seconds until it has arrived, or `seconds`.
  double run(double target, double seconds) {
    double t = 0.0;
    for (; t < seconds && !servo.arrived(); t += kServoStep) tick(target);
    return t;
  }
};

TEST(Servo, LeavesOtherThanItThinksArriveInTimeToo) {
  for (const double wrong : {0.8, 1.0, 1.2}) {
    for (const double inertia : {2.0, 5.4, 6.5}) {
      for (const double friction : {0.0, 0.1, 0.5}) {
        ServoSettings settings = door_settings();
        settings.inertia = inertia;
        settings.damping = 1.0;
        settings.friction = friction;
        Loop loop;
        loop.servo = Servo(settings);
        loop.plant.inertia = wrong * inertia;
        loop.plant.damping = wrong;
        loop.plant.friction = wrong * friction;
        loop.servo.start(0.0, 0.0);
        const double took = loop.run(-1.2, 6.0);
        SCOPED_TRACE(testing::Message()
                     << wrong << " times " << inertia << " kg m^2, friction " << friction);
        EXPECT_LT(took, 4.0);
        EXPECT_NEAR(loop.plant.position, -1.2, 0.006);
        EXPECT_GT(loop.deepest, -1.2 * 1.05);
        EXPECT_FALSE(loop.was_blocked);
      }
    }
  }
}

TEST(Servo, IsBlockedWithinASecondWhenHeld) {
  Loop loop;
  loop.servo.start(0.0, 0.0);
  for (int i = 0; i < 1000; ++i) loop.tick(-1.57);
  loop.plant.held = true;
  for (int i = 0; i < 900; ++i) loop.tick(-1.57);
  EXPECT_TRUE(loop.servo.blocked());
}

TEST(Servo, HeldItPushesTheOtherWayWhenItsTargetDoes) {
  for (const double held_at : {-0.1, -0.7, -1.1999999999999937}) {
    Loop loop;
    loop.plant.position = held_at;
    loop.plant.held = true;
    loop.servo.start(held_at, 0.0);
    for (int i = 0; i < 3000; ++i) loop.tick(-1.57);
    EXPECT_LT(loop.torque, 0.0);
    for (int i = 0; i < 1000; ++i) loop.tick(0.0);
    EXPECT_GT(loop.torque, 0.0) << held_at;
  }
}

// I x'' = p (target - x), so x = target (1 - cos(sqrt(p / I) t)).
TEST(Servo, PlainProportionalOneSwingsAsACosine) {
  ServoSettings settings = door_settings();
  settings.controller = Controller::kPid;
  settings.gains.i = settings.gains.d = 0.0;
  Loop loop;
  loop.servo = Servo(settings);
  loop.plant.damping = loop.plant.friction = 0.0;
  loop.servo.start(0.0, 0.0);
  double worst = 0.0;
  for (int i = 1; i <= 10000; ++i) {
    loop.tick(-0.7);
    const double exact = -0.7 * (1.0 - std::cos(std::sqrt(70.0 / 5.4) * i * kServoStep));
    worst = std::max(worst, std::abs(loop.plant.position - exact));
  }
  EXPECT_LT(worst, 0.005);
  EXPECT_FALSE(loop.was_blocked);
}

TEST(Servo, PlainOnesIntegralBeginsAnewWithEachTarget) {
  ServoSettings settings = door_settings();
  settings.controller = Controller::kPid;
  Loop loop;
  loop.servo = Servo(settings);
  loop.plant.held = true;
  loop.servo.start(0.0, 0.0);
  for (int i = 0; i < 1000; ++i) loop.tick(-0.1);
  EXPECT_NEAR(loop.torque, -7.0 - 20.0, 1e-9);
  loop.tick(0.2);
  EXPECT_NEAR(loop.torque, 14.0 + 200.0 * 0.2 * kServoStep, 1e-9);
}

TEST(Servo, WhatBouncesOffAnObstacleIsBlocked) {
  Loop loop;
  loop.servo.start(0.0, 0.0);
  double farthest_back = -0.8;
  for (int i = 0; i < 3500; ++i) {
    loop.tick(-1.57);
    if (loop.plant.position < -0.8) {
      loop.plant.position = -0.8;
      loop.plant.velocity *= -0.9;
    }
    if (i > 2500) farthest_back = std::max(farthest_back, loop.plant.position);
  }
  EXPECT_GT(farthest_back, -0.79) << "it still bounces";
  EXPECT_TRUE(loop.servo.blocked());
}

TEST(Servo, ForceOnWhatHoldsItGrowsToItsLimitAndNoFurther) {
  Loop loop;
  loop.plant.held = true;
  loop.servo.start(0.0, 0.0);
  for (int i = 0; i < 1000; ++i) loop.tick(-1.57);
  const double early = loop.torque;
  for (int i = 0; i < 60000; ++i) loop.tick(-1.57);
  EXPECT_LT(loop.torque, early);
  EXPECT_GE(loop.torque, -120.0);
}

TEST(Servo, IsNotFlungWhenFreed) {
  Loop loop;
  loop.plant.held = true;
  loop.servo.start(0.0, 0.0);
  for (int i = 0; i < 60000; ++i) loop.tick(-1.57);
  loop.plant.held = false;
  double fastest = 0.0;
  for (double t = 0.0; t < 6.0 && !loop.servo.arrived(); t += kServoStep) {
    loop.tick(-1.57);
    fastest = std::max(fastest, std::abs(loop.plant.velocity));
  }
  EXPECT_LT(fastest, 1.5);
  EXPECT_TRUE(loop.servo.arrived());
  EXPECT_FALSE(loop.servo.blocked());
}

TEST(Servo, TakesANewTargetOnTheWay) {
  Loop loop;
  loop.servo.start(0.0, 0.0);
  for (int i = 0; i < 1000; ++i) loop.tick(-1.57);
  EXPECT_LT(loop.run(0.0, 4.0), 4.0);
  EXPECT_NEAR(loop.plant.position, 0.0, 0.003);
}

}  // namespace
}  // namespace angen::devices
