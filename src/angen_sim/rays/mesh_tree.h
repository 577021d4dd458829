#pragma once

#include <memory>

#include "core/shape.h"
#include "rays/device.h"
#include "rays/triangle_tree.h"

namespace angen::rays {

/// The triangles of a mesh, in a hierarchy of Embree.
class MeshTree : public TriangleTree {
 public:
  explicit MeshTree(std::shared_ptr<const TriangleMesh> mesh);

  bool find_hit(const Vec3& origin, const Vec3& direction, double min, double max, double& range,
                std::uint32_t& triangle) const override;
  Vec3 normal(std::uint32_t triangle) const override;

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  Hierarchy tree_;
};

}  // namespace angen::rays
