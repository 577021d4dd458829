#pragma once

#include <cstdint>
#include <memory>

#include "core/shape.h"

namespace angen::rays {

/// Triangles in their own frame, with a hierarchy of Embree over them; shared by all their
/// placements.
class TriangleTree {
 public:
  virtual ~TriangleTree() = default;

  /// The tree of a mesh or a heightmap, kept while it is used; null if there is none.
  static std::shared_ptr<const TriangleTree> of(const std::shared_ptr<const TriangleMesh>& mesh);
  static std::shared_ptr<const TriangleTree> of(const std::shared_ptr<const HeightGrid>& grid);

  /// Nearest triangle in [min, max], from both sides; the lowest number on a tie. False without a
  /// hit.
  virtual bool find_hit(const Vec3& origin, const Vec3& direction, double min, double max,
                        double& range, std::uint32_t& triangle) const = 0;
  virtual Vec3 normal(std::uint32_t triangle) const = 0;
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  /// Triangles whose boxes a ray through `bounds` crosses, on average; 0 for a heightmap.
  double crossed() const { return crossed_; }

 protected:
  Eigen::AlignedBox3d bounds_;
  double crossed_ = 0.0;
};

}  // namespace angen::rays
