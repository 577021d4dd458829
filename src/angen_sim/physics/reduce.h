#pragma once

#include <cstddef>

#include "physics/ode.h"

namespace angen::physics {

/// Most points that a pair of geoms keeps.
constexpr std::size_t kMaxPoints = 8;

/// Keeps at most kMaxPoints of n points at the front, in a fixed order: the deepest, then each
/// time the one farthest from those kept; doubles go. Returns how many are left.
std::size_t reduce_points(dContactGeom* points, std::size_t n);

/// Keeps the deepest of points one above the other with one normal, as between two bodies of which
/// none can tilt: the others are redundant there, and the exact solver fails at them.
std::size_t reduce_upright(dContactGeom* points, std::size_t n);

}  // namespace angen::physics
