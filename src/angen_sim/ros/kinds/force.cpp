#include <geometry_msgs/Wrench.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

Command of_wrench(const geometry_msgs::Wrench& wrench) {
  return command_of({wrench.force.x, wrench.force.y, wrench.force.z, wrench.torque.x,
                     wrench.torque.y, wrench.torque.z});
}

ANGEN_REGISTER_ROS_KIND({"force"}, RosKindBuilder().commanded_by(&of_wrench, "topicName", ""));

}  // namespace
}  // namespace angen::node
