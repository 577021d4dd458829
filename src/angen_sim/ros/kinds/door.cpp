#include <angen_msgs/DoorState.h>
#include <angen_msgs/DoorStateArray.h>

#include "ros/kinds/states.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& state, const Label& label, angen_msgs::DoorState& message) {
  message.name = label.name;
  message.mode = constant_of(state, "mode");
  message.position = state.get<double>("position");
  message.velocity = state.get<double>("velocity");
  message.target = state.get<double>("target");
}

RosKindBuilder leaf() {
  return RosKindBuilder().message_with_array<angen_msgs::DoorState, angen_msgs::DoorStateArray>(
      &fill);
}

ANGEN_REGISTER_ROS_KIND({"door"}, leaf().label("door labels"));
ANGEN_REGISTER_ROS_KIND({"window", "cabinet"}, leaf());

}  // namespace
}  // namespace angen::node
