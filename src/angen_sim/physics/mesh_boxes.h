#pragma once

#include <cstddef>
#include <vector>

#include "core/pose.h"
#include "core/shape.h"

namespace angen::physics {

/// A tree of boxes around a mesh's triangles. It estimates the cost of a collision of two meshes,
/// before ODE begins with one: each of some thousand long triangles may cross each of the other
/// mesh.
class MeshBoxes {
 public:
  explicit MeshBoxes(const TriangleMesh& mesh);

  /// The tests of boxes and triangles that it takes to collide them, at most `most`.
  static std::size_t tests(const MeshBoxes& a, const Pose& a_at, const MeshBoxes& b,
                           const Pose& b_at, std::size_t most);
  /// Around all triangles, in the mesh's frame.
  Eigen::AlignedBox3d bounds() const;

 private:
  struct Node {
    Vec3 center = Vec3::Zero();
    Vec3 half = Vec3::Zero();
    std::size_t next = 0;   // the second child; the first is the next node
    std::size_t count = 0;  // triangles, of a leaf
  };
  struct Triangle {
    Eigen::AlignedBox3d box;
    Vec3 center;
  };

  void add(std::vector<Triangle>::iterator begin, std::vector<Triangle>::iterator end);

  std::vector<Node> nodes_;
};

}  // namespace angen::physics
