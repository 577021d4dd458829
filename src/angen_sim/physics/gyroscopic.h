#pragma once

#include <vector>

#include "physics/model.h"

namespace angen::physics {

/// Before a step of `step` seconds: the torques by which spinning bodies keep their angular
/// momentum. ODE's own, which slow bodies keep, loses energy.
void add_gyroscopic_torques(const std::vector<Body*>& awake, double step);

/// After it, at the bodies' poses before: the other torques on them, which the next step starts
/// from.
void note_torques(const std::vector<Body*>& awake, double step);

/// The spin of a body in the next step, from that of the last one and the angular impulse between
/// (N m s): rad/s, in its own axes at the tick between. None if it turns too far in a step.
std::optional<Vec3> next_spin(const Eigen::Matrix3d& moment, const Vec3& spin, const Vec3& impulse,
                              double step);

}  // namespace angen::physics
