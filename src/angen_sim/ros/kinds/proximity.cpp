#include <sensor_msgs/Range.h>

#include <algorithm>

#include "ros/convert.h"
#include "ros/kinds/frames.h"

namespace angen::node {
namespace {

/// The range is max_range if nothing is in reach, as in gazebo_ros_range: range_sensor_layer drops
/// infinite ranges.
void fill(const Reading& reading, const Label&, sensor_msgs::Range& message) {
  const auto number = [&](const char* name) {
    return static_cast<float>(reading.get<double>(name));
  };
  message.radiation_type =
      reading.get<bool>("infrared") ? sensor_msgs::Range::INFRARED : sensor_msgs::Range::ULTRASOUND;
  message.field_of_view = number("field_of_view");
  message.min_range = number("min_range");
  message.max_range = number("max_range");
  message.range = std::min(number("range"), message.max_range);
}

ANGEN_REGISTER_ROS_KIND({"proximity"}, RosKindBuilder().message<sensor_msgs::Range>(&fill).rays(
                                           "proximity cones", color(0.9F, 0.5F, 0.1F, 0.8F)));
ANGEN_REGISTER_ROS_KIND({"sonar"}, RosKindBuilder()
                                       .named_message<sensor_msgs::Range>(&fill, "sonar")
                                       .frame(frame_by({"frameId", "bodyName"}))
                                       .rays("proximity cones", color(0.9F, 0.5F, 0.1F, 0.8F)));

}  // namespace
}  // namespace angen::node
