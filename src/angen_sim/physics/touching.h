#pragma once

#include <cstddef>

#include "physics/model.h"

namespace angen::physics {

/// Most points that are searched for between two geoms.
constexpr std::size_t kMaxFound = 64;

/// The contact points of two geoms: writes up to kMaxFound `points`, and returns how many.
std::size_t touching_points(const Geom& first, const Geom& second, dContactGeom* points);
/// Contact points of a moving mesh and another mesh, with a box instead of the moving one.
std::size_t touching_box(const Geom& first, const Geom& second, dContactGeom* points);

}  // namespace angen::physics
