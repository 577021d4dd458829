#pragma once

#include <memory>

#include "core/shape.h"
#include "rays/device.h"

namespace angen::rays {

/// A triangle mesh in its own frame with a hierarchy of its own, shared by all its placements.
class MeshTree {
 public:
  explicit MeshTree(std::shared_ptr<const TriangleMesh> mesh);

  /// Nearest triangle in [min, max], both sides; on a tie the one that comes first.
  bool meet(const Vec3& origin, const Vec3& direction, double min, double max, double& range,
            std::uint32_t& triangle) const;
  Vec3 normal(std::uint32_t triangle) const;
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  Eigen::AlignedBox3d bounds_;
  Hierarchy tree_;
};

}  // namespace angen::rays
