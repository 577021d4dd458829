#include "render/box_tree.h"

#include <algorithm>

#include "rays/device.h"

namespace angen::render {
namespace {

constexpr unsigned kMaxDepth = 100;  // the stack of any() holds three boxes of each level

std::uint32_t link_of(const void* pointer) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(pointer));
}
void* pointer_of(std::size_t number, bool is_leaf) {
  return reinterpret_cast<void*>(2 * number + (is_leaf ? 1 : 0));
}

}  // namespace

void* BoxTree::add_node(RTCThreadLocalAllocator, unsigned count, void* tree) {
  std::vector<Node>& nodes = static_cast<BoxTree*>(tree)->nodes_;
  nodes.emplace_back().count = count;
  return pointer_of(nodes.size() - 1, false);
}

void* BoxTree::add_leaf(RTCThreadLocalAllocator, const RTCBuildPrimitive* box, std::size_t, void*) {
  return pointer_of(box->primID, true);
}

void BoxTree::set_next(void* node, void** next, unsigned count, void* tree) {
  Node& set = static_cast<BoxTree*>(tree)->nodes_[link_of(node) / 2];
  std::transform(next, next + count, set.next.begin(), link_of);
}

void BoxTree::set_boxes(void* node, const RTCBounds** boxes, unsigned count, void* tree) {
  Boxes4& set = static_cast<BoxTree*>(tree)->nodes_[link_of(node) / 2].boxes;
  for (unsigned i = 0; i < count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      set.min[axis][i] = (&boxes[i]->lower_x)[axis];
      set.max[axis][i] = (&boxes[i]->upper_x)[axis];
    }
  }
}

void BoxTree::build(const std::vector<Box>& boxes) {
  nodes_.clear();
  bounds_.setEmpty();
  std::vector<RTCBuildPrimitive> parts;
  for (const Box& box : boxes) {
    bounds_.extend(box);
    const Eigen::Vector3f &low = box.min(), &high = box.max();
    const auto number = static_cast<unsigned>(parts.size());
    parts.push_back({low.x(), low.y(), low.z(), 0, high.x(), high.y(), high.z(), number});
  }
  if (boxes.empty()) return;
  void* root = add_node(nullptr, 1, this);
  const Eigen::Vector3f &low = bounds_.min(), &high = bounds_.max();
  const RTCBounds all{low.x(), low.y(), low.z(), 0.0F, high.x(), high.y(), high.z(), 0.0F};
  const RTCBounds* only = &all;
  set_boxes(root, &only, 1, this);
  const rays::Embree<RTCBVH> memory(rtcNewBVH(rays::device()));
  RTCBuildArguments build = rtcDefaultBuildArguments();
  build.maxBranchingFactor = 4;
  build.maxDepth = kMaxDepth;
  build.maxLeafSize = 1;
  build.bvh = memory.get();
  build.primitives = parts.data();
  build.primitiveCount = build.primitiveArrayCapacity = parts.size();
  build.createNode = add_node;
  build.setNodeChildren = set_next;
  build.setNodeBounds = set_boxes;
  build.createLeaf = add_leaf;
  build.userPtr = this;
  void* next = rtcBuildBVH(&build);
  set_next(root, &next, 1, this);
}

}  // namespace angen::render
