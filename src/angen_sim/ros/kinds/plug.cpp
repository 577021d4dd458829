#include <angen_msgs/PlugMsg.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, angen_msgs::PlugMsg& message) {
  message.load = reading.get<std::string>("load");
  message.connected = reading.get<bool>("connected");
  message.power = reading.get<double>("power");
  message.energy = reading.get<double>("energy");
}

ANGEN_REGISTER_ROS_KIND({"plug"}, RosKindBuilder().message<angen_msgs::PlugMsg>(&fill).caption());

}  // namespace
}  // namespace angen::node
