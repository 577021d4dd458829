#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/pose.h"

/// Fixed, evenly spread directions and points, so that a reading changes only when the world does.
namespace angen::light {

constexpr std::size_t kLampPoints = 128;

/// `count` cosine-weighted directions about z that fill the hemisphere evenly.
std::vector<Vec3> cosine_directions(std::size_t count);

/// Points spread evenly over the unit square; so are the first sixteen.
const std::array<std::pair<double, double>, kLampPoints>& square_points();

/// Van der Corput's sequence: the bits of i behind the binary point, last bit first.
double radical_inverse(unsigned i);

/// Malley's method: maps a point of the unit square to a cosine-weighted direction about z.
Vec3 cosine_direction(double u, double v);

/// A right-handed frame whose z axis is the unit `normal`.
Eigen::Matrix3d frame_about(const Vec3& normal);

}  // namespace angen::light
