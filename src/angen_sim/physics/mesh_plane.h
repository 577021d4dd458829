#pragma once

#include <cstddef>

#include "physics/model.h"

namespace angen::physics {

/// Most points that collide_mesh_plane() finds.
constexpr std::size_t kMostOnPlane = 9;

/// As dCollide() of a mesh and a plane, the normals towards the mesh: the deepest vertex, and the
/// outermost ones of those below the plane in eight directions. ODE takes the first that it comes
/// upon, and looks at each triangle. Returns how many.
std::size_t collide_mesh_plane(const Geom& mesh, const Geom& plane, dContactGeom* points);

}  // namespace angen::physics
