#include <angen_msgs/BarometerMsg.h>

#include <cmath>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

// The troposphere of ISO 2533, as altimeters compute: 288.15 K at the reference, 6.5 K/km less.
double altitude_of(double pressure, double reference) {
  constexpr double kScale = 288.15 / 0.0065;  // m
  constexpr double kExponent =
      8.31432 * 0.0065 / (9.80665 * 0.0289644);  // exponent of the ratio of pressures
  return kScale * (1.0 - std::pow(pressure / reference, kExponent));
}

void fill(const Reading& reading, const Label& label, angen_msgs::BarometerMsg& message) {
  fill_by_name(reading, label, message, {"altitude"});
  message.altitude = altitude_of(message.pressure, message.reference_pressure);
}

ANGEN_REGISTER_ROS_KIND({"barometer"},
                        RosKindBuilder().message<angen_msgs::BarometerMsg>(&fill).caption());

}  // namespace
}  // namespace angen::node
