#include <sensor_msgs/BatteryState.h>

#include <limits>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& state, const Label&, sensor_msgs::BatteryState& message) {
  using Message = sensor_msgs::BatteryState;
  constexpr float kUnknown =
      std::numeric_limits<float>::quiet_NaN();  // what the message's definition asks for
  const auto number = [&](const char* name) { return static_cast<float>(state.get<double>(name)); };
  message.voltage = number("voltage");
  message.current = -number("drawn") / message.voltage;
  message.charge = number("charge");
  message.capacity = message.design_capacity = number("capacity");
  message.percentage = number("percentage");
  message.temperature = kUnknown;
  message.power_supply_status = Message::POWER_SUPPLY_STATUS_DISCHARGING;
  message.power_supply_health = Message::POWER_SUPPLY_HEALTH_UNKNOWN;
  message.power_supply_technology = Message::POWER_SUPPLY_TECHNOLOGY_LION;
  message.present = true;
}

ANGEN_REGISTER_ROS_KIND({"battery"},
                        RosKindBuilder().message<sensor_msgs::BatteryState>(&fill).caption());

}  // namespace
}  // namespace angen::node
