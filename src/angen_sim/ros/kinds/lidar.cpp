#include <sensor_msgs/LaserScan.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, sensor_msgs::LaserScan& message) {
  const auto number = [&](const char* name) {
    return static_cast<float>(reading.get<double>(name));
  };
  message.angle_min = number("angle_min");
  message.angle_max = number("angle_max");
  message.angle_increment = number("angle_increment");
  message.scan_time = number("scan_time");
  message.range_min = number("range_min");
  message.range_max = number("range_max");
  const auto ranges = reading.get<std::vector<double>>("ranges");
  message.ranges.assign(ranges.begin(), ranges.end());
  message.intensities.assign(ranges.size(), 0.0F);  // no surface has a <laser_retro> here
}

ANGEN_REGISTER_ROS_KIND({"lidar"}, RosKindBuilder().message<sensor_msgs::LaserScan>(&fill));

}  // namespace
}  // namespace angen::node
