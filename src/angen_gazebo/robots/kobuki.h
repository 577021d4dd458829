#pragma once

#include <array>
#include <string>

#include "robots/wheels.h"

namespace angen::robots {

// Parameters that name its sensors.
constexpr std::array<const char*, 3> kCliffNames{
    "cliff_sensor_left_name", "cliff_sensor_center_name", "cliff_sensor_right_name"};
constexpr std::array<const char*, 2> kDropNames{"wheel_drop_left_sensor_name",
                                                "wheel_drop_right_sensor_name"};
constexpr const char* kBumperName = "bumper_name";

/// The parameters of the one <plugin>, from which its drive and all its sensors are made.
struct KobukiSettings : WheelSettings {
  std::array<std::string, 3> cliffs;  // left, center, right
  double cliff = 0.0;                 // m
  std::array<std::string, 2> drops;   // left, right
  std::string bumper;
};
KobukiSettings read_kobuki(Params& params);

}  // namespace angen::robots
