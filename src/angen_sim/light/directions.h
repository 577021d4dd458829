#pragma once

#include <array>

#include "core/pose.h"

namespace angen::light {

constexpr int kPaths = 256;  // a measure follows
constexpr int kBounces = 4;  // surfaces on each path, beyond which the rest is estimated
constexpr int kLampPoints = 16;

/// Cosine-weighted directions about z, one for each path and bounce: at each bounce they fill the
/// hemisphere evenly. Always the same, so that a reading changes only when the world does.
using Directions = std::array<std::array<Vec3, kPaths>, kBounces>;
const Directions& directions();

/// Points spread evenly over the unit sphere.
const std::array<Vec3, kLampPoints>& lamp_points();

/// A right-handed frame whose z axis is the unit `normal`.
Eigen::Matrix3d frame_about(const Vec3& normal);

}  // namespace angen::light
