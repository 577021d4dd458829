#include "ros/states.h"

#include <array>
#include <limits>

#include "ros/convert.h"

namespace angen::node {
namespace {

// A mode stands in a state by its name; its place in the list is the message's constant.
template <std::size_t N>
std::uint8_t mode(const Reading& state, const char* field,
                  const std::array<const char*, N>& names) {
  const auto text = state.get<std::string>(field);
  for (std::size_t i = 0; i < N; ++i) {
    if (text == names[i]) return static_cast<std::uint8_t>(i);
  }
  return 0;
}

constexpr std::array kDoorModes{"CLOSED", "OPEN", "OPENING", "CLOSING", "BLOCKED", "AJAR"};
constexpr std::array kElevatorModes{"IDLE", "UP", "DOWN", "BLOCKED"};
constexpr std::array kPersonModes{"STANDING", "WALKING", "BLOCKED"};

std::int32_t floor_number(const Reading& state, const char* field) {
  return static_cast<std::int32_t>(state.get<std::int64_t>(field));
}

Pose flat_pose(const Reading& state, double z) {
  return {Vec3(state.get<double>("x"), state.get<double>("y"), z),
          from_rpy(0.0, 0.0, state.get<double>("yaw"))};
}

}  // namespace

Pose odometry_pose(const Reading& state) { return flat_pose(state, 0.0); }

void fill(const Reading& state, const Label& label, angen_msgs::DoorState& message) {
  message.name = label.name;
  message.mode = mode(state, "mode", kDoorModes);
  message.position = state.get<double>("position");
  message.velocity = state.get<double>("velocity");
  message.target = state.get<double>("target");
}

void fill(const Reading& state, const Label& label, angen_msgs::ElevatorState& message) {
  message.name = label.name;
  message.mode = mode(state, "mode", kElevatorModes);
  message.position = state.get<double>("position");
  message.velocity = state.get<double>("velocity");
  message.target = state.get<double>("target");
  message.floor = floor_number(state, "floor");
  message.target_floor = floor_number(state, "target_floor");
  message.door_mode = mode(state, "door_mode", kDoorModes);
  message.door_position = state.get<double>("door_position");
}

void fill(const Reading& state, const Label& label, angen_msgs::LampState& message) {
  message.name = label.name;
  message.on = state.get<bool>("on");
  message.level = state.get<double>("level");
  message.luminous_flux = state.get<double>("luminous_flux");
}

void fill(const Reading& state, const Label& label, angen_msgs::PersonState& message) {
  message.name = label.name;
  message.mode = mode(state, "mode", kPersonModes);
  message.pose = to_ros(flat_pose(state, state.get<double>("z")));
  message.speed = state.get<double>("speed");
}

void fill(const Reading& state, const Label&, sensor_msgs::BatteryState& message) {
  using Message = sensor_msgs::BatteryState;
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();  // as its definition says
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

void fill(const Reading& state, const Label& label, nav_msgs::Odometry& message) {
  message.child_frame_id = label.name;
  message.pose.pose = to_ros(odometry_pose(state));
  message.twist.twist.linear.x = state.get<double>("v");
  message.twist.twist.angular.z = state.get<double>("w");
  // Variances of what wheels cannot tell (z, roll, pitch) are large, of the rest small.
  constexpr std::array<double, 6> kVariances{1e-4, 1e-4, 1e6, 1e6, 1e6, 1e-3};
  for (std::size_t i = 0; i < kVariances.size(); ++i) {
    message.pose.covariance[i * 7] = message.twist.covariance[i * 7] = kVariances[i];
  }
}

}  // namespace angen::node
