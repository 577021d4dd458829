#include <algorithm>

#include "physics/joints.h"

namespace angen::physics {

Bounds velocity_bounds(const Joint& joint) {
  const Axis& axis = joint.axes[0];
  const double most = axis.velocity >= 0.0 ? axis.velocity : dInfinity;
  if (!axis.safety || axis.safety->k_position == 0.0) return {-most, most};
  const desc::JointSafety& safety = *axis.safety;
  const double k = safety.k_position;
  return {std::clamp(-k * (joint.position - safety.soft_lower), -most, most),
          std::clamp(-k * (joint.position - safety.soft_upper), -most, most)};
}

Bounds effort_bounds(const Joint& joint, double velocity) {
  const Axis& axis = joint.axes[0];
  const double most = axis.effort >= 0.0 ? axis.effort : dInfinity;
  const Bounds speeds = velocity_bounds(joint);
  if (axis.safety && axis.safety->k_velocity > 0.0) {
    const double k = axis.safety->k_velocity;
    return {std::clamp(-k * (velocity - speeds.low), -most, most),
            std::clamp(-k * (velocity - speeds.high), -most, most)};
  }
  return {velocity < speeds.low ? 0.0 : -most, velocity > speeds.high ? 0.0 : most};
}

}  // namespace angen::physics
