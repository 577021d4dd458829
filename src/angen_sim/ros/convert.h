#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Vector3.h>
#include <ros/time.h>
#include <std_msgs/ColorRGBA.h>

#include <array>
#include <cstddef>
#include <vector>

#include "core/diagnostics.h"
#include "core/pose.h"
#include "core/time.h"

namespace angen::node {

inline ros::Time to_ros(Nanoseconds time) {
  return ros::Time(static_cast<std::uint32_t>(time / kSecond),
                   static_cast<std::uint32_t>(time % kSecond));
}

inline geometry_msgs::Point to_point(const Vec3& v) {
  geometry_msgs::Point out;
  out.x = v.x();
  out.y = v.y();
  out.z = v.z();
  return out;
}

inline geometry_msgs::Vector3 to_vector(const Vec3& v) {
  geometry_msgs::Vector3 out;
  out.x = v.x();
  out.y = v.y();
  out.z = v.z();
  return out;
}

inline geometry_msgs::Quaternion to_ros(const Quat& q) {
  geometry_msgs::Quaternion out;
  out.x = q.x();
  out.y = q.y();
  out.z = q.z();
  out.w = q.w();
  return out;
}

inline geometry_msgs::Pose to_ros(const Pose& pose) {
  geometry_msgs::Pose out;
  out.position = to_point(pose.position);
  out.orientation = to_ros(pose.rotation);
  return out;
}

/// Its quaternion as it is, whatever its length. Throws Error for a number that is not finite.
inline Pose to_pose(const geometry_msgs::Pose& message) {
  const geometry_msgs::Quaternion& q = message.orientation;
  const Pose pose{{message.position.x, message.position.y, message.position.z},
                  Quat(q.w, q.x, q.y, q.z)};
  if (!pose.finite()) throw Error("the pose contains a number that is not finite");
  return pose;
}

inline geometry_msgs::Transform to_transform(const Pose& pose) {
  geometry_msgs::Transform out;
  out.translation = to_vector(pose.position);
  out.rotation = to_ros(pose.rotation);
  return out;
}

/// Adds a covariance of x, y and yaw, row by row, to one of x, y, z, roll, pitch and yaw.
template <class Covariance>
void add_planar(const std::vector<double>& planar, Covariance& covariance) {
  constexpr std::array<std::size_t, 3> kAt{0, 1, 5};
  for (std::size_t i = 0; i < 9; ++i) covariance[6 * kAt[i / 3] + kAt[i % 3]] += planar.at(i);
}

inline std_msgs::ColorRGBA color(float r, float g, float b, float a) {
  std_msgs::ColorRGBA out;
  out.r = r;
  out.g = g;
  out.b = b;
  out.a = a;
  return out;
}

}  // namespace angen::node
