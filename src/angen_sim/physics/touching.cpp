#include "physics/touching.h"

#include <algorithm>
#include <array>

namespace angen::physics {

namespace {

constexpr double kThinnest = 1e-3;  // m, of a box instead of a mesh
constexpr double kApart = 1e-9;     // m, centers that are less apart coincide

// ODE's cylinders have no normal (NaN) where a center is on an axis or two are exactly side by
// side: they are parted along the line between them, else the moving one upward.
void fix_normals(const Geom& first, const Geom& second, dContactGeom* points, std::size_t n) {
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

/// Contact points of a mesh or a heightmap's tile, `ground`, and another geom.
std::size_t collide_ground(dGeomID ground, const Geom& other, bool ground_first,
                           dContactGeom* points) {
  dGeomID solid = other.ode.get();
  const std::size_t n = ground_first ? ode::collide(ground, solid, kMaxFound, points)
                                     : ode::collide(solid, ground, kMaxFound, points);
  if (n == 0) return 0;
  const auto on_plane = [&](const Vec3& normal, double offset, dContactGeom* found) {
    if (other.mesh) return collide_mesh_plane(other, normal, offset, found);
    const ode::GeomHandle plane(dCreatePlane(nullptr, normal.x(), normal.y(), normal.z(), offset));
    return ode::collide(solid, plane.get(), kMaxOnPlane, found);
  };
  return fix_flat_parts(ground, solid, on_plane, ground_first, points, n, kMaxFound);
}

// A heightmap is ground: two of them do not touch.
std::size_t collide_tiles(const Geom& first, const Geom& second, dContactGeom* points) {
  if (first.tiles && second.tiles) return 0;
  const Geom& ground = first.tiles ? first : second;
  const Geom& other = first.tiles ? second : first;
  std::array<dContactGeom, kMaxFound> found;
  std::size_t n = 0;
  ground.tiles->each_in(in_frame_of(ground, other.box), [&](dTriMeshDataID mesh) {
    dGeomTriMeshSetData(ground.tile.get(), mesh);
    std::size_t count =
        collide_ground(ground.tile.get(), other, first.tiles != nullptr, found.data());
    fix_normals(first, second, found.data(), count);
    count = reduce_points(found.data(), count);
    if (n + count > kMaxFound) n = reduce_points(points, n);
    std::copy_n(found.begin(), count, points + n);
    n += count;
  });
  return n;
}

std::size_t collide_with_plane(const Geom& first, const Geom& second, dContactGeom* points) {
  const Geom& plane = first.is_plane ? first : second;
  dVector4 at;
  dGeomPlaneGetParams(plane.ode.get(), at);
  const std::size_t n =
      collide_mesh_plane(first.is_plane ? second : first, ode::vec(at), at[3], points);
  for (std::size_t i = 0; i < n; ++i) {
    points[i].g1 = first.ode.get();
    points[i].g2 = second.ode.get();
    if (!first.is_plane) continue;
    for (int axis = 0; axis < 3; ++axis) points[i].normal[axis] *= -1.0;
  }
  return n;
}

constexpr double kSamePlace = 1e-5;  // m
constexpr double kSameNormal = 0.99;

bool same(const dContactGeom& a, const dContactGeom& b) {
  return (ode::vec(a.pos) - ode::vec(b.pos)).norm() < kSamePlace &&
         ode::vec(a.normal).dot(ode::vec(b.normal)) > kSameNormal;
}

bool one_above_the_other(const dContactGeom& a, const dContactGeom& b) {
  return (ode::vec(a.pos) - ode::vec(b.pos)).head<2>().norm() < kSamePlace &&
         ode::vec(a.normal).dot(ode::vec(b.normal)) > kSameNormal;
}

// Keeps the deeper one of two points that are `twins`.
template <class Twins>
std::size_t remove_doubles(dContactGeom* points, std::size_t n, Twins&& twins) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    dContactGeom* twin = std::find_if(points, points + kept,
                                      [&](const dContactGeom& p) { return twins(p, points[i]); });
    if (twin == points + kept) {
      points[kept++] = points[i];
    } else if (points[i].depth > twin->depth) {
      *twin = points[i];
    }
  }
  return kept;
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
    return collide_boxes(a, b, points, kMaxFound);
  }
  std::size_t n = 0;
  if (first.mesh && !first.body->dynamic()) {
    n = collide_ground(a, second, true, points);
  } else if (second.mesh && !second.body->dynamic()) {
    n = collide_ground(b, first, false, points);
  } else {
    n = ode::collide(a, b, kMaxFound, points);
  }
  fix_normals(first, second, points, n);
  return n;
}

std::size_t touching_box(const Geom& first, const Geom& second, dContactGeom* points) {
  const bool first_moves = first.body->dynamic();
  const Geom& moving = first_moves ? first : second;
  const Eigen::AlignedBox3d bounds = moving.mesh->boxes->bounds();
  const Vec3 size = bounds.sizes().cwiseMax(kThinnest);
  const ode::GeomHandle box(dCreateBox(nullptr, size.x(), size.y(), size.z()));
  ode::set_pose(box.get(),
                moving.body->at * moving.in_body * Pose{bounds.center(), Quat::Identity()});
  const std::size_t n = first_moves ? ode::collide(box.get(), second.ode.get(), kMaxFound, points)
                                    : ode::collide(first.ode.get(), box.get(), kMaxFound, points);
  for (std::size_t i = 0; i < n; ++i) {
    points[i].g1 = first.ode.get();
    points[i].g2 = second.ode.get();
  }
  fix_normals(first, second, points, n);
  return n;
}

std::size_t reduce_upright(dContactGeom* points, std::size_t n) {
  return remove_doubles(points, n, one_above_the_other);
}

std::size_t reduce_points(dContactGeom* points, std::size_t n) {
  n = remove_doubles(points, n, same);
  if (n <= kMaxPoints) return n;
  std::iter_swap(points, std::max_element(points, points + n, [](const auto& a, const auto& b) {
                   return a.depth < b.depth;
                 }));
  for (std::size_t kept = 1; kept < kMaxPoints; ++kept) {
    std::size_t best = kept;
    double best_distance = -1.0;
    for (std::size_t i = kept; i < n; ++i) {
      double nearest = dInfinity;
      for (std::size_t k = 0; k < kept; ++k) {
        nearest = std::min(nearest, (ode::vec(points[i].pos) - ode::vec(points[k].pos)).norm());
      }
      if (nearest > best_distance) {
        best_distance = nearest;
        best = i;
      }
    }
    std::swap(points[kept], points[best]);
  }
  return kMaxPoints;
}

}  // namespace angen::physics
