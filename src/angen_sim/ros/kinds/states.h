#pragma once

#include <geometry_msgs/Twist.h>

#include "core/pose.h"
#include "plugin/reading.h"
#include "ros/command_topic.h"

namespace angen::node {

/// A field of numbers as a vector; missing ones are 0.
inline Vec3 vector_in(const Reading& reading, const char* field) {
  auto v = reading.get<std::vector<double>>(field);
  v.resize(3, 0.0);
  return Vec3::Map(v.data());
}

/// The field `orientation`, x y z w.
inline Quat orientation_in(const Reading& reading) {
  auto q = reading.get<std::vector<double>>("orientation");
  q.resize(4, 0.0);
  return Quat(q.data());
}

/// x, y and yaw of a state as a pose at height `z` (m).
inline Pose flat_pose(const Reading& state, double z) {
  return {Vec3(state.get<double>("x"), state.get<double>("y"), z),
          from_rpy(0.0, 0.0, state.get<double>("yaw"))};
}

/// A robot's pose by its wheels, in its odometry frame.
inline Pose odometry_pose(const Reading& state) { return flat_pose(state, 0.0); }

/// Speeds forward and about z, as wheels on an axle have them.
inline Command of_twist(const geometry_msgs::Twist& twist) {
  return command_of({twist.linear.x, twist.angular.z});
}

}  // namespace angen::node
