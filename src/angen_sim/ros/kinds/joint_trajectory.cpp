#include <trajectory_msgs/JointTrajectory.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

// The values of joint_pose_trajectory. A point with another number of positions than of joints
// makes the number of values wrong, and is rejected.
Command of_trajectory(const trajectory_msgs::JointTrajectory& trajectory) {
  Command command = command_of({trajectory.header.stamp.toSec()});
  for (const std::string& joint : trajectory.joint_names) command.text += joint + " ";
  for (const trajectory_msgs::JointTrajectoryPoint& point : trajectory.points) {
    command.values.push_back(point.time_from_start.toSec());
    command.values.insert(command.values.end(), point.positions.begin(), point.positions.end());
  }
  return command;
}

ANGEN_REGISTER_ROS_KIND({"joint_trajectory"},
                        RosKindBuilder().commanded_by(&of_trajectory, "topicName",
                                                      "set_joint_trajectory"));

}  // namespace
}  // namespace angen::node
