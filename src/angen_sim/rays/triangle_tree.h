#pragma once

#include <cstdint>

#include "core/pose.h"

namespace angen::rays {

/// Triangles in their own frame, with a hierarchy over them; shared by all their placements.
class TriangleTree {
 public:
  virtual ~TriangleTree() = default;

  /// Nearest triangle in [min, max], from both sides; the lowest number on a tie. False without a
  /// hit.
  virtual bool find_hit(const Vec3& origin, const Vec3& direction, double min, double max,
                        double& range, std::uint32_t& triangle) const = 0;
  virtual Vec3 normal(std::uint32_t triangle) const = 0;
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  /// Triangles whose boxes a ray through `bounds` crosses, on average.
  double crossed() const { return crossed_; }

 protected:
  Eigen::AlignedBox3d bounds_;
  double crossed_ = 0.0;
};

}  // namespace angen::rays
