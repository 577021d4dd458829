#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace angen::render {

using Box = Eigen::AlignedBox3f;

/// Four boxes, in columns.
struct Boxes4 {
  using Column = Eigen::Array<float, 4, 1>;

  std::array<Column, 3> min, max;  // by axis
};

/// A set of four boxes: bit i for the i-th.
using Four = unsigned;

/// Boxes that overlap a box.
inline Four overlapping(const Box& box, const Boxes4& boxes) {
  Four found = 0;
  for (unsigned i = 0; i < 4; ++i) {
    bool overlaps = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      overlaps =
          overlaps && boxes.min[axis][i] <= box.max()[k] && box.min()[k] <= boxes.max[axis][i];
    }
    if (overlaps) found |= 1U << i;
  }
  return found;
}

/// A hierarchy of boxes, with four in each node.
class BoxTree {
 public:
  /// Replaces all boxes.
  void build(std::vector<Box> boxes);

  /// Around all boxes; there is at least one.
  const Box& bounds() const { return bounds_; }
  /// Whether visit(i) is true for one of the boxes for which overlaps(box) is; it answers for four
  /// boxes at once.
  template <class Overlaps, class Visit>
  bool any(const Overlaps& overlaps, const Visit& visit) const {
    std::array<std::uint32_t, 512> waiting;  // at least 1/8 of the boxes each: 166 levels, halved
    std::size_t count = 0;
    if (!nodes_.empty()) waiting[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[waiting[--count]];
      const Four found = overlaps(node.boxes) & ((1U << node.count) - 1U);
      for (std::size_t i = 0; i < node.count; ++i) {
        if ((found >> i & 1U) == 0) continue;
        if (!node.is_leaf[i]) {
          waiting[count++] = node.next[i];
        } else if (visit(node.next[i])) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  struct Node {
    Boxes4 boxes;
    std::array<std::uint32_t, 4> next;  // a node, or the box's number in a leaf
    std::array<bool, 4> is_leaf;
    std::uint32_t count = 0;
  };

  std::vector<Node> nodes_;
  Box bounds_;
};

}  // namespace angen::render
