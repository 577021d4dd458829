#include <angen_msgs/LightSensArray.h>
#include <angen_msgs/LightSensMsg.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, angen_msgs::LightSensMsg& message) {
  message.illuminance = reading.get<double>("illuminance");
  message.r = static_cast<float>(reading.get<double>("r"));
  message.g = static_cast<float>(reading.get<double>("g"));
  message.b = static_cast<float>(reading.get<double>("b"));
}

ANGEN_REGISTER_ROS_KIND(
    {"luminosity"},
    RosKindBuilder().message_with_array<angen_msgs::LightSensMsg, angen_msgs::LightSensArray>(
        &fill));

}  // namespace
}  // namespace angen::node
