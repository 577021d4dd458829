#include <sensor_msgs/JointState.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, sensor_msgs::JointState& message) {
  message.name = reading.get<std::vector<std::string>>("names");
  message.position = reading.get<std::vector<double>>("positions");
  message.velocity = reading.get<std::vector<double>>("velocities");
  message.effort = reading.get<std::vector<double>>("efforts");
}

ANGEN_REGISTER_ROS_KIND({"joint_states", "wheel_states", "controlled_joints", "kobuki_wheels"},
                        RosKindBuilder().named_message<sensor_msgs::JointState>(&fill,
                                                                                "joint_states",
                                                                                "none"));

}  // namespace
}  // namespace angen::node
