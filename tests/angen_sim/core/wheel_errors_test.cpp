#include "core/wheel_errors.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "core/random.h"

namespace angen {
namespace {

constexpr double kError = 0.02;      // m after 1 m
constexpr double kSeparation = 0.4;  // m

Eigen::Matrix3d matrix_of(const WheelErrors& errors) {
  return Eigen::Map<const Eigen::Matrix3d>(errors.numbers().data());
}

TEST(WheelErrors, GrowWithTheWayStraightAhead) {
  WheelErrors errors(kError, kSeparation);
  for (int i = 0; i < 3000; ++i) errors.roll(1e-3, 1e-3, 0.0);
  const Eigen::Matrix3d found = matrix_of(errors);
  const double d = 3.0, variance = kError * kError;
  const double turn = 2.0 * variance / (kSeparation * kSeparation);  // rad^2/m
  EXPECT_NEAR(found(0, 0), variance * d / 2.0, 1e-9);
  EXPECT_NEAR(found(2, 2), turn * d, 1e-9);
  EXPECT_NEAR(found(1, 1), turn * d * d * d / 3.0, 1e-4 * found(1, 1));
  EXPECT_NEAR(found(1, 2), turn * d * d / 2.0, 1e-4 * found(1, 2));
  EXPECT_NEAR(found(0, 1), 0.0, 1e-12);
}

TEST(WheelErrors, AreThoseOfManyRobotsOnACurve) {
  const int robots = 4000, steps = 100;
  const double left = 0.015, right = 0.02;  // m a step
  WheelErrors errors(kError, kSeparation);
  double yaw = 0.0;
  for (int i = 0; i < steps; ++i, yaw += (right - left) / kSeparation) {
    errors.roll(left, right, yaw + (right - left) / kSeparation / 2.0);
  }
  Rng rng(1, 2, 3);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  for (int k = 0; k < robots; ++k) {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (int i = 0; i < steps; ++i) {
      const double l = left + kError * std::sqrt(left) * rng.gaussian();
      const double r = right + kError * std::sqrt(right) * rng.gaussian();
      const double middle = at.z() + (r - l) / kSeparation / 2.0;
      at += Eigen::Vector3d((l + r) / 2.0 * std::cos(middle), (l + r) / 2.0 * std::sin(middle),
                            (r - l) / kSeparation);
    }
    mean += at / robots;
    square += at * at.transpose() / robots;
  }
  const Eigen::Matrix3d sampled = square - mean * mean.transpose();
  EXPECT_LT((matrix_of(errors) - sampled).norm(), 0.1 * sampled.norm());
}

TEST(WheelErrors, OfAMeasuredHeadingAreAlongTheWay) {
  WheelErrors errors(kError, INFINITY);
  errors.roll(2.0, 2.0, M_PI / 2.0);
  EXPECT_NEAR(matrix_of(errors)(1, 1), kError * kError, 1e-12);
  EXPECT_NEAR(matrix_of(errors)(0, 0) + matrix_of(errors)(2, 2), 0.0, 1e-12);
}

}  // namespace
}  // namespace angen
