#include <angen_msgs/ElevatorState.h>
#include <angen_msgs/ElevatorStateArray.h>

#include "ros/kinds/states.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& state, const Label& label, angen_msgs::ElevatorState& message) {
  message.name = label.name;
  message.mode = constant_of(state, "mode");
  message.position = state.get<double>("position");
  message.velocity = state.get<double>("velocity");
  message.target = state.get<double>("target");
  message.floor = static_cast<std::int32_t>(state.get<std::int64_t>("floor"));
  message.target_floor = static_cast<std::int32_t>(state.get<std::int64_t>("target_floor"));
  message.floors = static_cast<std::int32_t>(state.get<std::int64_t>("floors"));
  message.load = state.get<double>("load");
  message.door_mode = constant_of(state, "door_mode");
  message.door_position = state.get<double>("door_position");
}

ANGEN_REGISTER_ROS_KIND(
    {"elevator"},
    RosKindBuilder().message_with_array<angen_msgs::ElevatorState, angen_msgs::ElevatorStateArray>(
        &fill));

}  // namespace
}  // namespace angen::node
