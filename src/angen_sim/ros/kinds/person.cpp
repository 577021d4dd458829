#include <angen_msgs/PersonState.h>
#include <angen_msgs/PersonStateArray.h>

#include "ros/convert.h"
#include "ros/kinds/states.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& state, const Label& label, angen_msgs::PersonState& message) {
  message.name = label.name;
  message.mode = constant_of(state, "mode");
  message.pose = to_ros(flat_pose(state, state.get<double>("z")));
  message.speed = state.get<double>("speed");
  message.going = state.get<bool>("going");
  message.unreachable = state.get<bool>("unreachable");
  message.why = state.get<std::string>("why");
}

ANGEN_REGISTER_ROS_KIND(
    {"person"},
    RosKindBuilder()
        .message_with_array<angen_msgs::PersonState, angen_msgs::PersonStateArray>(&fill)
        .label("labels"));

}  // namespace
}  // namespace angen::node
