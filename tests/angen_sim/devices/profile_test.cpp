#include "devices/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace angen::devices {
namespace {

constexpr double kProfileStep = 0.001;

struct Trip {
  double seconds = 0.0;
  double fastest = 0.0;
  double hardest = 0.0;
  double furthest = -1e9;
  bool arrived = false;
};

Trip run(Profile& profile, double target, double seconds) {
  Trip result;
  for (int i = 0; i * kProfileStep < seconds && !result.arrived; ++i) {
    profile.advance(target, kProfileStep);
    result.seconds += kProfileStep;
    result.fastest = std::max(result.fastest, std::abs(profile.velocity()));
    result.hardest = std::max(result.hardest, std::abs(profile.acceleration()));
    result.furthest = std::max(result.furthest, profile.position());
    result.arrived = profile.at(target);
  }
  return result;
}

TEST(Profile, TrapezoidTakesTheClosedFormsTime) {
  Profile profile(1.0, 0.5);
  profile.start(0.0);
  const Trip result = run(profile, 4.0, 20.0);
  ASSERT_TRUE(result.arrived);
  EXPECT_NEAR(result.seconds, 4.0 / 1.0 + 1.0 / 0.5, 0.005);
  EXPECT_NEAR(result.fastest, 1.0, 1e-9);
  EXPECT_LE(result.hardest, 0.5 + 1e-6);
}

TEST(Profile, ShortWayIsATriangle) {
  Profile profile(1.0, 2.0);
  profile.start(0.1);
  const Trip result = run(profile, 0.0, 5.0);
  ASSERT_TRUE(result.arrived);
  EXPECT_NEAR(result.seconds, 2.0 * std::sqrt(0.1 / 2.0), 0.005);
  EXPECT_NEAR(result.fastest, std::sqrt(0.1 * 2.0), 0.005);
}

TEST(Profile, NeverPassesItsTarget) {
  for (const double target : {4.0, 1.57, 0.3333, 0.01, 1e-4, 1e-7}) {
    Profile profile(0.7, 1.3);
    profile.start(0.0);
    const Trip result = run(profile, target, 20.0);
    EXPECT_TRUE(result.arrived) << target;
    EXPECT_LE(result.furthest, target) << target;
  }
}

TEST(Profile, ArrivesExactlyWithCoarseSteps) {
  for (const double dt : {0.0005, 0.003, 0.01, 0.05}) {
    Profile profile(1.0, 2.0);
    profile.start(0.0);
    for (int i = 0; i * dt < 6.0; ++i) profile.advance(-1.57, dt);
    EXPECT_EQ(profile.position(), -1.57) << dt;
    EXPECT_EQ(profile.velocity(), 0.0) << dt;
  }
}

TEST(Profile, TurnsRoundWithinItsAcceleration) {
  Profile profile(1.0, 2.0);
  profile.start(0.0);
  for (int i = 0; i < 1000; ++i) profile.advance(10.0, kProfileStep);
  ASSERT_NEAR(profile.velocity(), 1.0, 1e-6);
  const double turn = profile.position();
  const Trip result = run(profile, 0.0, 10.0);
  ASSERT_TRUE(result.arrived);
  EXPECT_LE(result.hardest, 2.0 + 1e-6);
  EXPECT_NEAR(result.furthest, turn + 1.0 / (2.0 * 2.0), 1e-3);
}

TEST(Profile, StoppingTooLateComesBack) {
  Profile profile(1.0, 2.0);
  profile.start(0.0, 1.0);
  const Trip result = run(profile, 0.1, 10.0);
  ASSERT_TRUE(result.arrived);
  EXPECT_NEAR(result.furthest, 1.0 / (2.0 * 2.0), 1e-3);
}

}  // namespace
}  // namespace angen::devices
