#include "ros/kinds/joint_states.h"

#include <sensor_msgs/JointState.h>

#include "ros/kinds/frames.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, sensor_msgs::JointState& message) {
  message.name = reading.get<std::vector<std::string>>("names");
  message.position = reading.get<std::vector<double>>("positions");
  message.velocity = reading.get<std::vector<double>>("velocities");
  message.effort = reading.get<std::vector<double>>("efforts");
}

}  // namespace

RosKindBuilder joint_states() {
  return RosKindBuilder()
      .named_message<sensor_msgs::JointState>(&fill, "joint_states", "none")
      .frame(&no_frame);
}

ANGEN_REGISTER_ROS_KIND({"joint_states", "wheel_states", "kobuki_wheels"}, joint_states());

}  // namespace angen::node
