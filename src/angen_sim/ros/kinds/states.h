#pragma once

#include <cstdint>

#include "core/pose.h"
#include "plugin/reading.h"

namespace angen::node {

/// The message constant of a choice, as a door's mode; 0 if there is none.
inline std::uint8_t constant_of(const Reading& state, const char* field) {
  return static_cast<std::uint8_t>(state.get<Choice>(field).value);
}

/// x, y and yaw of a state as a pose at height `z` (m).
inline Pose flat_pose(const Reading& state, double z) {
  return {Vec3(state.get<double>("x"), state.get<double>("y"), z),
          from_rpy(0.0, 0.0, state.get<double>("yaw"))};
}

/// A robot's pose by its wheels, in its odometry frame.
inline Pose odometry_pose(const Reading& state) { return flat_pose(state, 0.0); }

}  // namespace angen::node
