#pragma once

#include <cstdint>
#include <optional>

#include "sim/snapshot.h"

namespace angen::scene {

/// The field of view of a sensor, in its own frame.
struct Field {
  double min_yaw = 0.0;  // rad, positive to the left
  double max_yaw = 0.0;
  double min_pitch = 0.0;  // rad, positive upwards
  double max_pitch = 0.0;
  double range = 0.0;      // m; infinite of a camera
  std::uint32_t rays = 0;  // 0 of a camera
};

/// The field of a sensor with rays or of a camera; none of others.
std::optional<Field> field_of(const sim::SensorEntry& sensor);

}  // namespace angen::scene
