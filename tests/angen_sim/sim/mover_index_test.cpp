#include "sim/mover_index.h"

#include <gtest/gtest.h>

#include <set>

namespace angen::sim {
namespace {

using Box = MoverIndex::Box;
using WatchRegion = MoverIndex::WatchRegion;

rays::ShapeId mover(std::uint32_t index) {
  rays::ShapeId id;
  id.index = index;
  id.generation = 1;
  return id;
}

/// A cube of 0.2 m about a point on the x axis.
Box cube_at(double x) { return {Vec3(x - 0.1, -0.1, -0.1), Vec3(x + 0.1, 0.1, 0.1)}; }

const Box kRegion(Vec3(0, -1, -1), Vec3(2, 1, 1));

std::size_t count_visits(const MoverIndex& index, MoverIndex::Moment since) {
  std::set<std::uint32_t> visited;
  index.each_changed_since(since, [&](std::uint32_t region) { visited.insert(region); });
  return visited.size();
}

TEST(MoverIndex, ARegionKnowsTheMoversInItsBox) {
  MoverIndex index;
  index.put(mover(0), cube_at(1.0));
  const WatchRegion region(index, kRegion);
  index.put(mover(1), cube_at(0.5));
  index.put(mover(2), cube_at(20.0));
  EXPECT_EQ(region.near(), (std::vector<rays::ShapeId>{mover(0), mover(1)}));
  index.remove(mover(0));
  EXPECT_EQ(region.near(), std::vector<rays::ShapeId>{mover(1)});
  index.put(mover(1), cube_at(-20.0));
  EXPECT_TRUE(region.near().empty());
}

TEST(MoverIndex, AWarmedShapeConcernsItsRegionAndMovesNothing) {
  MoverIndex index;
  const WatchRegion region(index, kRegion);
  const WatchRegion far(index, {Vec3(40, -1, -1), Vec3(42, 1, 1)});
  index.advance();
  index.warm(cube_at(1.0));
  EXPECT_TRUE(index.changed_or_warmed_since(region.number(), index.now()));
  EXPECT_FALSE(index.changed_or_warmed_since(far.number(), index.now()));
  EXPECT_FALSE(region.changed_since(index.now()));
  EXPECT_EQ(count_visits(index, index.now()), 1U);
  index.advance();
  EXPECT_FALSE(index.changed_or_warmed_since(region.number(), index.now()));
}

TEST(MoverIndex, AMoverChangesItsRegionAndNoOther) {
  MoverIndex index;
  const WatchRegion region(index, kRegion);
  const WatchRegion far(index, {Vec3(40, -1, -1), Vec3(42, 1, 1)});
  index.put(mover(0), cube_at(1.0));
  EXPECT_TRUE(region.changed_since(index.now()));
  EXPECT_FALSE(far.changed_since(index.now()));
  index.advance();
  EXPECT_FALSE(region.changed_since(index.now()));
  EXPECT_EQ(count_visits(index, index.now()), 0U);
  index.put(mover(0), cube_at(1.01));  // within the margin of its box
  EXPECT_TRUE(region.changed_since(index.now()));
  EXPECT_EQ(count_visits(index, index.now()), 1U);
  index.advance();
  index.remove(mover(0));
  EXPECT_TRUE(region.changed_since(index.now()));
}

TEST(MoverIndex, MoversAreSplitByWhenTheyMovedLast) {
  MoverIndex index;
  const WatchRegion region(index, kRegion);
  index.put(mover(0), cube_at(0.5));
  index.advance();
  const MoverIndex::Moment since = index.now();
  index.put(mover(1), cube_at(1.5));
  index.advance();
  MoverIndex::SplitMovers split;
  region.split(since, split);
  EXPECT_EQ(split.still, std::vector<rays::ShapeId>{mover(0)});
  EXPECT_EQ(split.moving, std::vector<rays::ShapeId>{mover(1)});
  EXPECT_EQ(split.longest, since);
}

TEST(MoverIndex, WhatHasNoEndIsNearEveryRegion) {
  MoverIndex index;
  const WatchRegion region(index, kRegion);
  const Vec3 corner = Vec3::Constant(std::numeric_limits<double>::infinity());
  index.put(mover(0), {-corner, corner});
  EXPECT_EQ(region.near(), std::vector<rays::ShapeId>{mover(0)});
  index.advance();
  index.put(mover(0), {-corner, corner});
  EXPECT_TRUE(region.changed_since(index.now()));
  EXPECT_EQ(count_visits(index, index.now()), 1U);
}

TEST(MoverIndex, AStaticChangeIsTakenOnce) {
  MoverIndex index;
  WatchRegion region(index, kRegion);
  WatchRegion far(index, {Vec3(40, -1, -1), Vec3(42, 1, 1)});
  index.change_static(cube_at(1.0));
  EXPECT_TRUE(region.changed_since(index.now() + 1));
  EXPECT_TRUE(region.take_static_change());
  EXPECT_FALSE(region.take_static_change());
  EXPECT_FALSE(far.take_static_change());
}

TEST(MoverIndex, AResizedRegionHasTheMoversOfItsNewBox) {
  MoverIndex index;
  WatchRegion region(index, kRegion);
  index.put(mover(0), cube_at(1.0));
  index.put(mover(1), cube_at(41.0));
  region.resize({Vec3(40, -1, -1), Vec3(42, 1, 1)});
  EXPECT_EQ(region.near(), std::vector<rays::ShapeId>{mover(1)});
}

}  // namespace
}  // namespace angen::sim
