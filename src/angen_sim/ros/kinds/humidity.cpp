#include <sensor_msgs/RelativeHumidity.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

/// Between 0 and 1, as that message has it.
void fill(const Reading& reading, const Label&, sensor_msgs::RelativeHumidity& message) {
  message.relative_humidity = reading.get<double>("humidity") / 100.0;
  message.variance = reading.get<double>("variance") / 1e4;
}

ANGEN_REGISTER_ROS_KIND({"humidity"},
                        RosKindBuilder().message<sensor_msgs::RelativeHumidity>(&fill).caption());

}  // namespace
}  // namespace angen::node
