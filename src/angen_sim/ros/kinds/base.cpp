#include "ros/kinds/twist.h"
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

}  // namespace
}  // namespace angen::node
