#include <angen_msgs/PirArray.h>
#include <angen_msgs/PirMsg.h>

#include "ros/convert.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, angen_msgs::PirMsg& message) {
  message.motion = reading.get<bool>("motion");
  message.departure = reading.get<bool>("departure", false);
  message.difference = reading.get<double>("difference", 0.0);
  message.threshold = reading.get<double>("threshold", 0.0);
  message.signal = reading.get<double>("signal");
  message.signal_threshold = reading.get<double>("signal_threshold");
}

ANGEN_REGISTER_ROS_KIND({"pir"},
                        RosKindBuilder()
                            .message_with_array<angen_msgs::PirMsg, angen_msgs::PirArray>(&fill)
                            .rays("PIR rays", color(1.0F, 0.25F, 0.1F, 0.8F)));

}  // namespace
}  // namespace angen::node
