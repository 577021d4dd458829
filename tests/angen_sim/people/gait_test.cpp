// The limbs of a person who walks swing against each other, and hang down when it stands.
#include "people/gait.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace angen::people {
namespace {

const Vec3 kFoot(0.0, 0.09, 0.05);
constexpr int kThigh = 0;
constexpr int kShank = 2;
constexpr int kUpperArm = 4;

Pose place_at(double x) { return {{x, 0.0, 0.0}, Quat::Identity()}; }

TEST(Gait, LegsSwingAgainstEachOtherAndArmsAgainstLegs) {
  Gait gait;
  double least = 0.0;
  double most = 0.0;
  for (double x = 0.0; x < 3.0; x += 0.01) {
    gait.advance(place_at(x), 1.0);
    const double left = (gait.limb(kShank) * kFoot).x();
    const double right = (gait.limb(kShank + 1) * Vec3(kFoot.x(), -kFoot.y(), kFoot.z())).x();
    const double arm = (gait.limb(kUpperArm) * Vec3(0.0, 0.22, 1.1)).x();
    const double leg = (gait.limb(kThigh) * Vec3(0.0, 0.09, 0.5)).x();
    EXPECT_LE(arm * leg, 1e-12);
    EXPECT_GT((gait.limb(kShank) * kFoot).z(), 0.04);
    least = std::min(least, left - right);
    most = std::max(most, left - right);
  }
  EXPECT_LT(least, -0.5);
  EXPECT_GT(most, 0.5);
}

TEST(Gait, TwoStepsAreAStride) {
  Gait gait;
  gait.advance(place_at(0.0), 1.0);
  for (int i = 1; i <= 35; ++i) gait.advance(place_at(0.01 * i), 1.0);  // a fourth
  const double ahead = (gait.limb(kThigh) * Vec3(0.0, 0.09, 0.5)).x();
  for (int i = 36; i <= 105; ++i) gait.advance(place_at(0.01 * i), 1.0);  // and half of one
  EXPECT_GT(ahead, 0.15);
  EXPECT_NEAR((gait.limb(kThigh) * Vec3(0.0, 0.09, 0.5)).x(), -ahead, 1e-9);
}

TEST(Gait, WhoStandsOrIsPlacedElsewhereTakesNoStep) {
  Gait gait;
  gait.advance(place_at(0.0), 1.0);
  gait.advance(place_at(0.3), 1.0);
  const Pose limb = gait.limb(kThigh);
  gait.advance(place_at(5.0), 1.0);
  EXPECT_EQ(gait.limb(kThigh), limb);
  gait.advance(place_at(5.0), 0.0);
  for (int number = 0; number < Gait::kLimbs; ++number) EXPECT_EQ(gait.limb(number), Pose{});
}

}  // namespace
}  // namespace angen::people
