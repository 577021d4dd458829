#pragma once

#include <cstddef>

#include "physics/model.h"

namespace angen::physics {

/// Most points that are searched for between two geoms.
constexpr std::size_t kMaxFound = 64;

/// The contact points of two geoms: writes up to kMaxFound `points`, and returns how many.
std::size_t touching_points(const Geom& first, const Geom& second, dContactGeom* points);
/// The same of a moving mesh and another mesh, with the box around the moving one in its place.
std::size_t touching_box(const Geom& first, const Geom& second, dContactGeom* points);

}  // namespace angen::physics
