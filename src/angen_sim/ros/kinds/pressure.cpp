#include <angen_msgs/PressureMsg.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, angen_msgs::PressureMsg& message) {
  message.pressed = reading.get<bool>("pressed");
  message.load = reading.get<double>("load");
  message.threshold = reading.get<double>("threshold");
}

ANGEN_REGISTER_ROS_KIND({"pressure"},
                        RosKindBuilder().message<angen_msgs::PressureMsg>(&fill).caption());

}  // namespace
}  // namespace angen::node
