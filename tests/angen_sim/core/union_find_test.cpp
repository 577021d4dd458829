#include "core/union_find.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

TEST(UnionFind, TheLeastOfAGroupStandsForIt) {
  UnionFind groups(6);
  groups.join(5, 3);
  groups.join(4, 1);
  EXPECT_EQ(groups.root(5), 3);
  EXPECT_EQ(groups.root(4), 1);
  EXPECT_EQ(groups.root(2), 2);
  groups.join(5, 4);
  groups.join(3, 1);
  for (const std::size_t i : {1, 3, 4, 5}) EXPECT_EQ(groups.root(i), 1) << i;
  EXPECT_EQ(groups.root(0), 0);
}

}  // namespace
}  // namespace angen
