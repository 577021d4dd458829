#pragma once

#include <cstddef>
#include <functional>

#include "physics/mesh_plane.h"
#include "physics/ode.h"

namespace angen::physics {

/// Finds where a solid touches the half-space below a plane (normal · x = offset): writes up to
/// kMaxOnPlane points with normals towards the solid, and returns how many.
using OnPlane = std::function<std::size_t(const Vec3& normal, double offset, dContactGeom* points)>;

/// Contacts of a mesh and a solid, n of at most `most`: where the solid rests on triangles that
/// lie in one plane, those with that plane take their place. ODE's normals lean at the edges
/// between such triangles, even as far as to the side, and it also reports where a wheel's round
/// dips into the next one, which brakes it. `mesh_first`: the mesh is the contacts' first geom.
/// Returns how many are left.
std::size_t fix_flat_parts(dGeomID mesh, dGeomID solid, const OnPlane& on_plane, bool mesh_first,
                           dContactGeom* points, std::size_t n, std::size_t most);

}  // namespace angen::physics
