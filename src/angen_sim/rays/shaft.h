#pragma once

#include <array>
#include <vector>

#include "rays/scene.h"

namespace angen::rays {

struct Solid;

/// The convex hull of a point and a box, m, world.
class ShaftHull {
 public:
  /// Shapes that are less than `near` m from the point in all of their parts are not in it.
  ShaftHull(const Vec3& from, double near, const Eigen::AlignedBox3d& to);

  /// False only where the solid has no part in the hull.
  bool overlaps(const Solid& solid) const;
  /// Whether a convex solid separates the point from the box, farther than `near` from the point.
  bool is_cut_by(const Solid& solid) const;
  /// Around the hull.
  const Eigen::AlignedBox3d& box() const { return box_; }

 private:
  struct Side {
    Vec3 outward;
    double offset;  // offset of the plane: outward . p
  };

  void add_sides(int u, int v);
  bool is_beside(const Eigen::AlignedBox3d& box) const;
  bool is_beside_faces(const Solid& solid) const;

  Vec3 from_;
  double near_;
  std::array<Vec3, 8> corners_;  // corners of the box at its end
  Eigen::AlignedBox3d box_;
  std::array<Side, 12> sides_;
  std::size_t side_count_ = 0;
};

/// The rays from a point to one shape, and the shapes that may block some of them: those in the
/// hull of the point and the shape's box (shaft culling, Haines and Wallace 1991). Valid until the
/// scene changes.
class Shaft {
 public:
  struct Blocker {
    const Solid* solid;
    bool fixed;
  };

  Shaft(const ShaftHull& hull, Blocker target, std::vector<Blocker> blockers);

  /// Whether no other shape can block any of the rays.
  bool clear() const { return blockers_.empty(); }
  /// The index of a convex shape that blocks all of them; UINT32_MAX if none does.
  std::uint32_t blocked_by() const;
  /// Equal for the same shapes in the same poses: then sees() has the same answers for a
  /// target that has not moved.
  std::uint64_t fingerprint() const;
  /// Whether a ray from the point would hit the shape if there were no others.
  bool reaches(const Ray& ray) const;
  /// Whether a ray from the point hits the shape before any other: as Scene::cast() answers, bit
  /// for bit.
  bool sees(const Ray& ray) const;

 private:
  ShaftHull hull_;
  Blocker target_;
  std::vector<Blocker> blockers_;
};

}  // namespace angen::rays
