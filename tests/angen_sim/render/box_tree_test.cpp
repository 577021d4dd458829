#include "render/box_tree.h"

#include <gtest/gtest.h>

#include <set>

#include "core/pose.h"
#include "core/random.h"

namespace angen::render {
namespace {

Box some_box(Rng& rng) {
  const Eigen::Vector3f at =
      10.0F * Vec3(rng.uniform(), rng.uniform(), rng.uniform()).cast<float>();
  const Eigen::Vector3f size = Vec3(rng.uniform(), rng.uniform(), rng.uniform()).cast<float>();
  return {at, at + size};
}

std::set<std::uint32_t> found(const BoxTree& tree, const Box& in) {
  std::set<std::uint32_t> all;
  tree.any([&](const Boxes4& boxes) { return overlapping(in, boxes); },
           [&](std::uint32_t i) {
             all.insert(i);
             return false;
           });
  return all;
}

TEST(BoxTree, FindsTheBoxesThatALoopFinds) {
  Rng rng(1, hash_bytes("box tree"), 0);
  for (const std::size_t count : {0U, 1U, 2U, 3U, 7U, 500U}) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) boxes.push_back(some_box(rng));
    BoxTree tree;
    tree.build(boxes);
    for (int k = 0; k < 50; ++k) {
      const Box in = some_box(rng);
      std::set<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < count; ++i) {
        if (boxes[i].intersects(in)) expected.insert(i);
      }
      EXPECT_EQ(found(tree, in), expected);
    }
  }
}

TEST(BoxTree, HoldsBoxesInOnePlace) {
  const Box box(Eigen::Vector3f::Zero(), Eigen::Vector3f::Ones());
  BoxTree tree;
  tree.build(std::vector<Box>(1000, box));
  EXPECT_EQ(found(tree, box).size(), 1000U);
  EXPECT_EQ(tree.bounds().max(), box.max());
}

TEST(BoxTree, EndsWithTheFirstBoxThatCounts) {
  const Box box(Eigen::Vector3f::Zero(), Eigen::Vector3f::Ones());
  BoxTree tree;
  tree.build(std::vector<Box>(10, box));
  int visits = 0;
  const auto all = [](const Boxes4&) { return Four{15}; };
  EXPECT_TRUE(tree.any(all, [&](std::uint32_t) { return ++visits == 3; }));
  EXPECT_EQ(visits, 3);
}

}  // namespace
}  // namespace angen::render
