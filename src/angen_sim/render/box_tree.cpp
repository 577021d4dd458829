#include "render/box_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "core/pose.h"

namespace angen::render {
namespace {

constexpr int kBins = 16;
constexpr std::size_t kLeastShare = 8;  // 1/8 of the boxes on each side: at most 166 levels

float area(const Box& box) { return box.isEmpty() ? 0.0F : half_surface(box); }

/// Some boxes, as numbers, and how to divide them.
struct Bins {
  /// Bins of boxes whose middles are from `low` to `high` on an axis.
  Bins(int on_axis, float from, float to)
      : axis(on_axis), low(from), per_bin(kBins / (to - from)) {}

  int of(const Box& box) const {
    return std::clamp(static_cast<int>((box.center()[axis] - low) * per_bin), 0, kBins - 1);
  }
  void add(const Box& box) {
    Bin& bin = bins[static_cast<std::size_t>(of(box))];
    bin.box.extend(box);
    ++bin.count;
  }
  /// The first bin on the far side of the best division (surface area heuristic, binned, Wald
  /// 2007); 0 if all leave one side with few boxes.
  int best(std::size_t total, float& cost) const {
    std::array<float, kBins> behind{};
    Box box;
    std::size_t count = 0;
    for (std::size_t i = kBins - 1; i > 0; --i) {
      box.extend(bins[i].box);
      count += bins[i].count;
      behind[i] = static_cast<float>(count) * area(box);
    }
    box.setEmpty();
    count = 0;
    int found = 0;
    for (std::size_t i = 1; i < kBins; ++i) {
      box.extend(bins[i - 1].box);
      count += bins[i - 1].count;
      const float now = static_cast<float>(count) * area(box) + behind[i];
      const std::size_t least = std::min(count, total - count);
      if (least == 0 || least < total / kLeastShare || !(now < cost)) continue;
      cost = now;
      found = static_cast<int>(i);
    }
    return found;
  }

  struct Bin {
    Box box;
    std::size_t count = 0;
  };
  int axis;
  float low, per_bin;
  std::array<Bin, kBins> bins;
};

using Order = std::vector<std::uint32_t>::iterator;

/// Divides boxes in two, neither of them empty.
Order divide(const std::vector<Box>& boxes, Order begin, Order end) {
  Box middles;
  for (auto i = begin; i != end; ++i) middles.extend(boxes[*i].center());
  const auto total = static_cast<std::size_t>(end - begin);
  float cost = std::numeric_limits<float>::infinity();
  std::optional<Bins> chosen;
  int first = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(middles.sizes()[axis] > 0.0F)) continue;
    Bins bins(axis, middles.min()[axis], middles.max()[axis]);
    for (auto i = begin; i != end; ++i) bins.add(boxes[*i]);
    const int best = bins.best(total, cost);
    if (best == 0) continue;
    first = best;
    chosen = bins;
  }
  if (chosen) {
    return std::partition(begin, end,
                          [&](std::uint32_t i) { return chosen->of(boxes[i]) < first; });
  }
  int axis = 0;
  middles.sizes().maxCoeff(&axis);
  const auto half = begin + (end - begin) / 2;
  std::nth_element(begin, half, end, [&](std::uint32_t a, std::uint32_t b) {
    return boxes[a].center()[axis] < boxes[b].center()[axis];
  });
  return half;
}

}  // namespace

void BoxTree::build(std::vector<Box> boxes) {
  struct Part {
    std::size_t begin, end;
  };
  nodes_.clear();
  bounds_.setEmpty();
  if (boxes.empty()) return;
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto box_of = [&](const Part& part) {
    Box box;
    for (std::size_t i = part.begin; i < part.end; ++i) box.extend(boxes[order[i]]);
    return box;
  };
  const auto split = [&](const Part& part, Part& left, Part& right) {
    const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto middle =
        static_cast<std::size_t>(divide(boxes, at(part.begin), at(part.end)) - order.begin());
    left = {part.begin, middle};
    right = {middle, part.end};
  };
  bounds_ = box_of({0, boxes.size()});
  std::vector<std::pair<std::size_t, Part>> parts{{0, {0, boxes.size()}}};
  nodes_.emplace_back();
  while (!parts.empty()) {
    const auto [number, part] = parts.back();
    parts.pop_back();
    std::array<Part, 4> children{part};
    std::size_t count = 1;
    while (count < 4) {
      const auto largest = std::max_element(
          children.begin(), children.begin() + count,
          [](const Part& a, const Part& b) { return a.end - a.begin < b.end - b.begin; });
      if (largest->end - largest->begin < 2) break;
      Part left, right;
      split(*largest, left, right);
      *largest = left;
      children[count++] = right;
    }
    Node node;
    node.count = static_cast<std::uint32_t>(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Box box = box_of(children[i]);
      for (int axis = 0; axis < 3; ++axis) {
        node.boxes.min[axis][i] = box.min()[axis];
        node.boxes.max[axis][i] = box.max()[axis];
      }
      node.is_leaf[i] = children[i].end - children[i].begin == 1;
      node.next[i] = order[children[i].begin];
      if (node.is_leaf[i]) continue;
      node.next[i] = static_cast<std::uint32_t>(nodes_.size());
      nodes_.emplace_back();
      parts.emplace_back(node.next[i], children[i]);
    }
    nodes_[number] = node;
  }
}

}  // namespace angen::render
