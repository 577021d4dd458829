#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "core/shape.h"
#include "rays/triangle_tree.h"

namespace angen::rays {

/// A shape placed in the world, for tests against rays.
struct Solid {
  Shape::Type type = Shape::Type::kEmpty;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // own frame to world
  Vec3 position = Vec3::Zero();
  Vec3 half = Vec3::Zero();  // box: half lengths; cylinder, capsule: z is half the length
  double radius = 0.0;
  std::uint32_t slot = UINT32_MAX;
  std::uint64_t placed = 0;  // counts placements in its scene; the number of its latest one
  bool aligned = true;       // rotation is exactly the identity
  bool anchored = false;
  mutable bool loose = false;                // has moved since its layer's hierarchy was built
  std::shared_ptr<const TriangleTree> mesh;  // also of a heightmap, which is a mesh here
  Eigen::AlignedBox3d box;                   // m, world; empty for a plane, bad sizes or a bad pose

  /// Requires all other members.
  void place(const Pose& pose);
};

/// The first surface of one solid at or beyond `min`. `feature` is the face: a box's axis, a
/// cylinder's wall (0) or end (1), a mesh's triangle.
struct Intersection {
  double range = std::numeric_limits<double>::infinity();
  std::uint32_t feature = 0;
};

/// The solid's box in its own frame, m; empty if its sizes are invalid.
Eigen::AlignedBox3d own_box(const Solid& solid);

/// m: a point closer to a convex solid counts as inside. A ray from there that ignores what is
/// nearer than its margin would start in it.
constexpr double kSkin = 2e-4;

/// Whether a convex solid contains the point (m, world); false for a mesh or a plane.
bool contains(const Solid& solid, const Vec3& point);

/// Whether a ray hits the solid in [min, max]; all in double. The direction need not be unit:
/// ranges are multiples of its length. The hit does not depend on max.
bool find_hit(const Solid& solid, const Vec3& origin, const Vec3& direction, double min, double max,
              Intersection& out);

/// Unit normal (world) at the hit that `find_hit` found, on the side of the ray's origin.
Vec3 normal_at(const Solid& solid, const Vec3& origin, const Vec3& direction,
               const Intersection& hit);

}  // namespace angen::rays
