#include <angen_msgs/ReedMsg.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, angen_msgs::ReedMsg& message) {
  message.closed = reading.get<bool>("closed");
  message.distance = reading.get<double>("distance");
  message.operate_distance = reading.get<double>("operate_distance");
  message.release_distance = reading.get<double>("release_distance");
}

ANGEN_REGISTER_ROS_KIND({"reed"}, RosKindBuilder().message<angen_msgs::ReedMsg>(&fill).caption());

}  // namespace
}  // namespace angen::node
