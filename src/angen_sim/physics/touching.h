#pragma once

#include <cstddef>
#include <functional>

#include "physics/model.h"
#include "physics/ode.h"

namespace angen::physics {

/// Most points that are searched for between two geoms.
constexpr std::size_t kMaxFound = 64;

/// The contact points of two geoms: writes up to kMaxFound `points`, and returns how many.
std::size_t touching_points(const Geom& first, const Geom& second, dContactGeom* points);
/// Contact points of a moving mesh and another mesh, with a box instead of the moving one.
std::size_t touching_box(const Geom& first, const Geom& second, dContactGeom* points);

/// Most points that a pair of geoms keeps.
constexpr std::size_t kMaxPoints = 8;

/// Keeps at most kMaxPoints of n points at the front, in a fixed order: the deepest, then each
/// time the one farthest from those kept; doubles go. Returns how many are left.
std::size_t reduce_points(dContactGeom* points, std::size_t n);

/// Keeps the deepest of points one above the other with one normal, as between two bodies of which
/// none can tilt: the others are redundant there, and the exact solver fails at them.
std::size_t reduce_upright(dContactGeom* points, std::size_t n);

/// Like dCollide() of two boxes: up to `most` points in the world's frame, the normals towards `a`;
/// returns their number. ODE 0.16 overlooks some overlaps of boxes whose sides are all but
/// parallel, such as those of all upright boxes: rounding then decides between equal axes.
std::size_t collide_boxes(dGeomID a, dGeomID b, dContactGeom* points, std::size_t most);

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

/// Most points that collide_mesh_plane() finds.
constexpr std::size_t kMaxOnPlane = 9;

/// Where a mesh is below a plane (normal · x = offset): the deepest vertex, and the outermost ones
/// in eight directions, the normals towards the mesh. ODE takes the first that it comes upon, and
/// looks at each triangle. Returns how many.
std::size_t collide_mesh_plane(const Geom& mesh, const Vec3& normal, double offset,
                               dContactGeom* points);

}  // namespace angen::physics
