#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace angen {

using Vec3 = Eigen::Vector3d;
using Quat = Eigen::Quaterniond;

/// A rigid transform: position in meters, unit quaternion. `a * b` is b's frame seen from a's
/// parent.
struct Pose {
  Vec3 position = Vec3::Zero();
  Quat rotation = Quat::Identity();

  Pose operator*(const Pose& child) const {
    return {position + rotation * child.position, (rotation * child.rotation).normalized()};
  }
  Vec3 operator*(const Vec3& point) const { return position + rotation * point; }
  Pose inverse() const {
    const Quat back = rotation.conjugate();
    return {-(back * position), back};
  }
  bool operator==(const Pose& other) const {
    return position == other.position && rotation.coeffs() == other.rotation.coeffs();
  }
  bool operator!=(const Pose& other) const { return !(*this == other); }
  bool finite() const { return position.allFinite() && rotation.coeffs().allFinite(); }
};

/// SDF's roll, pitch, yaw in radians about the fixed x, y, z axes.
inline Quat from_rpy(double roll, double pitch, double yaw) {
  return Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
         Eigen::AngleAxisd(roll, Vec3::UnitX());
}

/// The inverse of from_rpy, pitch in [-pi/2, pi/2].
inline Vec3 to_rpy(const Quat& q) {
  const Eigen::Matrix3d r = q.toRotationMatrix();
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  if (std::hypot(r(0, 0), r(1, 0)) < 1e-9) {
    return {std::atan2(-r(1, 2), r(1, 1)), pitch, 0.0};
  }
  return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
}

/// Half of the surface of a box.
template <class Scalar>
Scalar half_surface(const Eigen::AlignedBox<Scalar, 3>& box) {
  const Eigen::Matrix<Scalar, 3, 1> size = box.sizes();
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

inline double yaw_of(const Quat& q) {
  return std::atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()));
}

}  // namespace angen
