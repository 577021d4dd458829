#include "core/pose.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

constexpr double kHalfPi = M_PI / 2;

TEST(Rpy, TurnsAboutFixedAxesInTheOrderXyz) {
  const Quat q = from_rpy(kHalfPi, 0.0, kHalfPi);
  EXPECT_LT((q * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_LT((q * Vec3::UnitY() - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((q * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-12);
}

TEST(Rpy, ToRpyIsTheInverse) {
  for (const double roll : {-3.0, -0.5, 0.0, 1.0}) {
    for (const double pitch : {-kHalfPi, -1.5, 0.0, 0.7, kHalfPi}) {
      for (const double yaw : {-2.0, 0.0, 3.1}) {
        const Quat q = from_rpy(roll, pitch, yaw);
        const Vec3 rpy = to_rpy(q);
        EXPECT_LT(q.angularDistance(from_rpy(rpy.x(), rpy.y(), rpy.z())), 3e-8)
            << roll << " " << pitch << " " << yaw;
      }
    }
  }
}

TEST(Rpy, YawOfALevelRotation) {
  EXPECT_NEAR(yaw_of(from_rpy(0.0, 0.0, 2.5)), 2.5, 1e-12);
  EXPECT_NEAR(yaw_of(from_rpy(0.0, 0.0, -2.5)), -2.5, 1e-12);
}

TEST(Pose, ProductAndInverse) {
  const Pose a{{1.0, 2.0, 3.0}, from_rpy(0.1, 0.2, 0.3)};
  const Pose b{{-1.0, 0.5, 2.0}, from_rpy(1.0, -0.4, 0.0)};
  const Vec3 point(0.3, -0.2, 0.9);
  EXPECT_LT(((a * b) * point - a * (b * point)).norm(), 1e-12);
  EXPECT_LT((a.inverse() * (a * point) - point).norm(), 1e-12);
}

TEST(Pose, FiniteSeesEveryNumber) {
  Pose pose;
  EXPECT_TRUE(pose.finite());
  pose.rotation.y() = NAN;
  EXPECT_FALSE(pose.finite());
}

}  // namespace
}  // namespace angen
