// Messages that command robots made for Gazebo.
#include <geometry_msgs/Wrench.h>
#include <trajectory_msgs/JointTrajectory.h>

#include "ros/kinds/states.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

Command of_flat_twist(const geometry_msgs::Twist& twist) {
  return command_of({twist.linear.x, twist.linear.y, twist.angular.z});
}

ANGEN_REGISTER_ROS_KIND({"diff_drive", "skid_steer_drive"},
                        RosKindBuilder().commanded_by(&of_twist, "commandTopic", "cmd_vel"));
ANGEN_REGISTER_ROS_KIND({"planar_move"},
                        RosKindBuilder().commanded_by(&of_flat_twist, "commandTopic", "cmd_vel"));

Command of_wrench(const geometry_msgs::Wrench& wrench) {
  return command_of({wrench.force.x, wrench.force.y, wrench.force.z, wrench.torque.x,
                     wrench.torque.y, wrench.torque.z});
}

ANGEN_REGISTER_ROS_KIND({"force"}, RosKindBuilder().commanded_by(&of_wrench, "topicName", ""));

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
