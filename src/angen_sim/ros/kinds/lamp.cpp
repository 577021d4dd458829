#include <angen_msgs/LampState.h>
#include <angen_msgs/LampStateArray.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& state, const Label& label, angen_msgs::LampState& message) {
  message.name = label.name;
  message.on = state.get<bool>("on");
  message.level = state.get<double>("level");
  message.luminous_flux = state.get<double>("luminous_flux");
  message.illuminance = state.get<double>("illuminance", 0.0);
}

ANGEN_REGISTER_ROS_KIND(
    {"lamp"}, RosKindBuilder()
                  .message_with_array<angen_msgs::LampState, angen_msgs::LampStateArray>(&fill)
                  .label("labels"));

}  // namespace
}  // namespace angen::node
