#include "render/box_tree.h"

#include <algorithm>
#include <numeric>

namespace angen::render {

void BoxTree::build(std::vector<Box> boxes) {
  struct Part {
    std::size_t node, begin, end;
  };
  nodes_.clear();
  if (boxes.empty()) return;
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0U);
  nodes_.reserve(2 * boxes.size());
  nodes_.emplace_back();
  std::vector<Part> parts{{0, 0, boxes.size()}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    Box box, middles;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      box.extend(boxes[order[i]]);
      middles.extend(boxes[order[i]].center());
    }
    nodes_[part.node].box = box;
    if (part.end - part.begin == 1) {
      nodes_[part.node].item = order[part.begin];
      continue;
    }
    int axis = 0;
    middles.sizes().maxCoeff(&axis);
    const std::size_t half = (part.begin + part.end) / 2;
    const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(part.begin), at(half), at(part.end), [&](std::uint32_t a, std::uint32_t b) {
      return boxes[a].center()[axis] < boxes[b].center()[axis];
    });
    const std::size_t left = nodes_.size();
    nodes_[part.node].left = static_cast<std::uint32_t>(left);
    nodes_.resize(left + 2);
    parts.push_back({left, part.begin, half});
    parts.push_back({left + 1, half, part.end});
  }
}

}  // namespace angen::render
