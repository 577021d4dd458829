#include <angen_msgs/SwitchArray.h>
#include <angen_msgs/SwitchMsg.h>

#include <algorithm>

#include "ros/convert.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, angen_msgs::SwitchMsg& message) {
  message.closed = reading.get<bool>("closed");
  message.changed = reading.get<bool>("changed");
  const auto ranges = reading.get<std::vector<double>>("ranges");
  std::copy_n(ranges.begin(), std::min(ranges.size(), message.ranges.size()),
              message.ranges.begin());
  message.difference = reading.get<double>("difference");
  message.threshold = reading.get<double>("threshold");
}

ANGEN_REGISTER_ROS_KIND(
    {"switch"},
    RosKindBuilder().message_with_array<angen_msgs::SwitchMsg, angen_msgs::SwitchArray>(&fill).rays(
        "switch beams", color(0.1F, 0.8F, 0.2F, 1.0F)));

}  // namespace
}  // namespace angen::node
