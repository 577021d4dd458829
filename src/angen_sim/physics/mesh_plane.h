#pragma once

#include <cstddef>

#include "physics/model.h"

namespace angen::physics {

/// Most points that collide_mesh_plane() finds.
constexpr std::size_t kMaxOnPlane = 9;

/// Where a mesh is below a plane (normal · x = offset): the deepest vertex, and the outermost ones
/// in eight directions, the normals towards the mesh. ODE takes the first that it comes upon, and
/// looks at each triangle. Returns how many.
std::size_t collide_mesh_plane(const Geom& mesh, const Vec3& normal, double offset,
                               dContactGeom* points);

}  // namespace angen::physics
