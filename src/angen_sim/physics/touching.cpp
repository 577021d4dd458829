#include "physics/touching.h"

#include <algorithm>
#include <array>
#include <utility>

#include "physics/boxes.h"
#include "physics/mesh_plane.h"
#include "physics/reduce.h"

namespace angen::physics {

namespace {

constexpr double kApart = 1e-9;  // m, centers that are less apart coincide

// ODE's cylinders have no normal (NaN) where a center lies on an axis or two stand exactly side by
// side: they are parted along the line between them, else the moving one upward.
void mend_normals(const Geom& first, const Geom& second, dContactGeom* points, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    if (ode::vec(points[i].normal).allFinite()) continue;
    Vec3 away =
        ode::vec(dGeomGetPosition(first.ode.get())) - ode::vec(dGeomGetPosition(second.ode.get()));
    if (away.norm() < kApart) away = Vec3(0.0, 0.0, first.body->dynamic() ? 1.0 : -1.0);
    away.normalize();
    for (int axis = 0; axis < 3; ++axis) points[i].normal[axis] = away[axis];
  }
}

/// The box in the world as one in the geom's own frame.
Eigen::AlignedBox3d in_frame_of(const Geom& geom, const Aabb& box) {
  const Pose to_own = (geom.body->at * geom.in_body).inverse();
  const Vec3 half = to_own.rotation.toRotationMatrix().cwiseAbs() * (box.max - box.min) / 2;
  const Vec3 center = to_own * Vec3((box.min + box.max) / 2);
  return {center - half, center + half};
}

// None where ODE fails, at a degenerate triangle, say.
std::size_t collide_geoms(dGeomID a, dGeomID b, dContactGeom* points) {
  try {
    return static_cast<std::size_t>(
        dCollide(a, b, static_cast<int>(kMostFound), points, sizeof(dContactGeom)));
  } catch (const ode::Failure&) {
    return 0;
  }
}

// A heightmap is ground: two of them do not touch.
std::size_t collide_tiles(const Geom& first, const Geom& second, dContactGeom* points) {
  if (first.tiles && second.tiles) return 0;
  const Geom& ground = first.tiles ? first : second;
  const Geom& other = first.tiles ? second : first;
  std::array<dContactGeom, kMostFound> found;
  std::size_t n = 0;
  ground.tiles->each_in(in_frame_of(ground, other.box), [&](dTriMeshDataID mesh) {
    dGeomTriMeshSetData(ground.tile.get(), mesh);
    dGeomID a = first.tiles ? ground.tile.get() : first.ode.get();
    dGeomID b = first.tiles ? second.ode.get() : ground.tile.get();
    std::size_t count = collide_geoms(a, b, found.data());
    mend_normals(first, second, found.data(), count);
    count = reduce_points(found.data(), count);
    if (n + count > kMostFound) n = reduce_points(points, n);
    std::copy_n(found.begin(), count, points + n);
    n += count;
  });
  return n;
}

std::size_t collide_with_plane(const Geom& first, const Geom& second, dContactGeom* points) {
  if (second.is_plane) return collide_mesh_plane(first, second, points);
  const std::size_t n = collide_mesh_plane(second, first, points);
  for (std::size_t i = 0; i < n; ++i) {
    std::swap(points[i].g1, points[i].g2);
    for (int axis = 0; axis < 3; ++axis) points[i].normal[axis] *= -1.0;
  }
  return n;
}

}  // namespace

std::size_t touching_points(const Geom& first, const Geom& second, dContactGeom* points) {
  if (first.tiles || second.tiles) return collide_tiles(first, second, points);
  if ((first.mesh && second.is_plane) || (first.is_plane && second.mesh)) {
    return collide_with_plane(first, second, points);
  }
  dGeomID a = first.ode.get();
  dGeomID b = second.ode.get();
  if (dGeomGetClass(a) == dBoxClass && dGeomGetClass(b) == dBoxClass) {
    return collide_boxes(a, b, points, kMostFound);
  }
  const std::size_t n = collide_geoms(a, b, points);
  mend_normals(first, second, points, n);
  return n;
}

}  // namespace angen::physics
