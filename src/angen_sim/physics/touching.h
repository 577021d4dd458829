#pragma once

#include <cstddef>

#include "physics/model.h"

namespace angen::physics {

/// Most points that are searched for between two geoms.
constexpr std::size_t kMaxFound = 64;

/// The contact points of two geoms: writes up to kMaxFound `points`, and returns how many.
std::size_t touching_points(const Geom& first, const Geom& second, dContactGeom* points);

}  // namespace angen::physics
