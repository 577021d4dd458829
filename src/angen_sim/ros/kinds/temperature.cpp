#include <sensor_msgs/Temperature.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, sensor_msgs::Temperature& message) {
  message.temperature = reading.get<double>("temperature");
  message.variance = reading.get<double>("variance");
}

ANGEN_REGISTER_ROS_KIND({"temperature"},
                        RosKindBuilder().message<sensor_msgs::Temperature>(&fill).caption());

}  // namespace
}  // namespace angen::node
