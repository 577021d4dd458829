#include <angen_msgs/RssiMsg.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, angen_msgs::RssiMsg& message) {
  message.ids = reading.get<std::vector<std::string>>("ids");
  message.rssi = reading.get<std::vector<double>>("rssi");
}

ANGEN_REGISTER_ROS_KIND({"receiver"},
                        RosKindBuilder().message<angen_msgs::RssiMsg>(&fill).caption());

}  // namespace
}  // namespace angen::node
