#include <angen_msgs/RfidMsg.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, angen_msgs::RfidMsg& message) {
  message.ids = reading.get<std::vector<std::string>>("ids");
  message.distances = reading.get<std::vector<double>>("distances");
}

ANGEN_REGISTER_ROS_KIND({"rfid"}, RosKindBuilder().message<angen_msgs::RfidMsg>(&fill).caption());

}  // namespace
}  // namespace angen::node
