#pragma once

#include <cstddef>

#include "physics/ode.h"

namespace angen::physics {

/// Most points that a pair of geoms keeps.
constexpr std::size_t kMostPoints = 8;

/// Keeps at most kMostPoints of n points at the front, in a fixed order: the deepest, then each
/// time the one farthest from those kept; doubles go. Returns how many are left.
std::size_t reduce_points(dContactGeom* points, std::size_t n);

}  // namespace angen::physics
