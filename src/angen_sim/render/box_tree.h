#pragma once

#include <embree3/rtcore.h>

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

/// A hierarchy of boxes, with up to four in each node, which Embree divides.
class BoxTree {
 public:
  /// Replaces all boxes.
  void build(const std::vector<Box>& boxes);

  /// Around all boxes; there is at least one.
  const Box& bounds() const { return bounds_; }
  /// Whether visit(i) is true for one of the boxes for which overlaps(box) is; it answers for four
  /// boxes at once.
  template <class Overlaps, class Visit>
  bool any(const Overlaps& overlaps, const Visit& visit) const {
    std::array<std::uint32_t, 512> waiting;
    std::size_t count = 0;
    if (!nodes_.empty()) waiting[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[waiting[--count]];
      const Four found = overlaps(node.boxes) & ((1U << node.count) - 1U);
      for (std::size_t i = 0; i < node.count; ++i) {
        if ((found >> i & 1U) == 0) continue;
        const std::uint32_t next = node.next[i] / 2;
        if (node.next[i] % 2 == 0) {
          waiting[count++] = next;
        } else if (visit(next)) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  struct Node {
    Boxes4 boxes;
    std::array<std::uint32_t, 4> next;  // twice a node's number, or a box's and one more
    std::uint32_t count = 0;
  };

  // The builder calls these; a node is twice its number.
  static void* add_node(RTCThreadLocalAllocator, unsigned count, void* tree);
  static void* add_leaf(RTCThreadLocalAllocator, const RTCBuildPrimitive* box, std::size_t, void*);
  static void set_next(void* node, void** next, unsigned count, void* tree);
  static void set_boxes(void* node, const RTCBounds** boxes, unsigned count, void* tree);

  std::vector<Node> nodes_;  // the first has all boxes
  Box bounds_;
};

}  // namespace angen::render
