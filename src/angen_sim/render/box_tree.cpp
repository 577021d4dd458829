#include "render/box_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

namespace angen::render {
namespace {

constexpr int kBins = 16;
constexpr std::size_t kLeastShare = 8;  // 1/8 of the boxes on each side: at most 166 levels

float area(const Box& box) {
  if (box.isEmpty()) return 0.0F;
  const Eigen::Vector3f size = box.sizes();
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

/// Some boxes, as numbers, and how to divide them.
struct Bins {
  /// Of boxes whose middles are from `low` to `high` on an axis.
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
    Box box;
    for (std::size_t i = part.begin; i < part.end; ++i) box.extend(boxes[order[i]]);
    nodes_[part.node].box = box;
    if (part.end - part.begin == 1) {
      nodes_[part.node].item = order[part.begin];
      continue;
    }
    const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto middle =
        static_cast<std::size_t>(divide(boxes, at(part.begin), at(part.end)) - order.begin());
    const std::size_t left = nodes_.size();
    nodes_[part.node].left = static_cast<std::uint32_t>(left);
    nodes_.resize(left + 2);
    parts.push_back({left, part.begin, middle});
    parts.push_back({left + 1, middle, part.end});
  }
}

}  // namespace angen::render
