#include <nav_msgs/Odometry.h>

#include <array>
#include <vector>

#include "ros/convert.h"
#include "ros/kinds/states.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

/// child_frame_id is label.name here.
void fill(const Reading& state, const Label& label, nav_msgs::Odometry& message) {
  message.child_frame_id = label.name;
  message.pose.pose = to_ros(odometry_pose(state));
  message.twist.twist.linear.x = state.get<double>("v");
  message.twist.twist.angular.z = state.get<double>("w");
  // Variances are large where wheels measure nothing (z, roll, pitch), otherwise small.
  constexpr std::array<double, 6> kDriveVariances{1e-4, 1e-4, 1e6, 1e6, 1e6, 1e-3};
  for (std::size_t i = 0; i < kDriveVariances.size(); ++i) {
    message.pose.covariance[i * 7] = message.twist.covariance[i * 7] = kDriveVariances[i];
  }
  add_planar(state.get<std::vector<double>>("covariance"), message.pose.covariance);
}

ANGEN_REGISTER_ROS_KIND(
    {"drive"},
    RosKindBuilder().message<nav_msgs::Odometry>(&fill).robot(&of_twist).label("labels"));

}  // namespace
}  // namespace angen::node
