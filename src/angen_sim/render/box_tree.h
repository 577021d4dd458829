#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace angen::render {

using Box = Eigen::AlignedBox3f;

/// A hierarchy of boxes.
class BoxTree {
 public:
  /// Replaces all boxes.
  void build(std::vector<Box> boxes);

  /// Around all boxes; there is at least one.
  const Box& bounds() const { return nodes_.front().box; }
  /// Whether visit(i) is true for one of the boxes for which overlaps(box) is.
  template <class Overlaps, class Visit>
  bool any(const Overlaps& overlaps, const Visit& visit) const {
    std::array<std::uint32_t, 192> waiting;  // at least 1/8 of the boxes each: 166 levels
    std::size_t count = 0;
    if (!nodes_.empty()) waiting[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[waiting[--count]];
      if (!overlaps(node.box)) continue;
      if (node.left == 0) {
        if (visit(node.item)) return true;
        continue;
      }
      waiting[count++] = node.left;
      waiting[count++] = node.left + 1;
    }
    return false;
  }

 private:
  struct Node {
    Box box;
    std::uint32_t left = 0;  // of two neighbors; 0 in a leaf
    std::uint32_t item = 0;
  };

  std::vector<Node> nodes_;
};

}  // namespace angen::render
