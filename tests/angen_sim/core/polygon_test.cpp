#include "core/polygon.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

const Polygon kSquare = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
// 4 x 3 without its upper right quarter of 2 x 1.
const Polygon kCorner = {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 3}, {0, 3}};

TEST(Polygon, HasAnAreaByItsDirection) {
  EXPECT_DOUBLE_EQ(signed_area(kSquare), 4.0);
  EXPECT_DOUBLE_EQ(signed_area({{0, 2}, {2, 2}, {2, 0}, {0, 0}}), -4.0);
  EXPECT_DOUBLE_EQ(signed_area(kCorner), 10.0);
}

TEST(Polygon, HasTheSameAreaFarAway) {
  Polygon far = kCorner;
  for (Point2& corner : far) corner += Point2(9e5, -9e5);
  EXPECT_NEAR(signed_area(far), 10.0, 1e-6);
}

TEST(Polygon, ContainsWhatIsBetweenItsEdges) {
  EXPECT_TRUE(contains(kCorner, {1.0, 2.5}));
  EXPECT_TRUE(contains(kCorner, {3.5, 1.5}));
  EXPECT_FALSE(contains(kCorner, {3.0, 2.5}));
  EXPECT_FALSE(contains(kCorner, {-0.1, 1.0}));
  EXPECT_FALSE(contains(kCorner, {5.0, 2.0}));  // at the height of corners
}

TEST(Polygon, IsAsFarAsItsNearestEdge) {
  EXPECT_DOUBLE_EQ(distance_to_edge(kSquare, {1.0, 0.25}), 0.25);
  EXPECT_DOUBLE_EQ(distance_to_edge(kSquare, {5.0, 6.0}), 5.0);
}

TEST(Polygon, IsSimpleWhereItsEdgesMeetAtCornersOnly) {
  EXPECT_FALSE(crossing_edges(kSquare));
  EXPECT_FALSE(crossing_edges(kCorner));
  EXPECT_FALSE(crossing_edges({{0, 0}, {1, 0}, {0, 1}}));
}

TEST(Polygon, CrossesItself) {
  EXPECT_TRUE(crossing_edges({{0, 0}, {2, 2}, {2, 0}, {0, 2}}));          // a bow tie
  EXPECT_TRUE(crossing_edges({{0, 0}, {4, 0}, {4, 3}, {2, 0}, {0, 3}}));  // touches its own edge
  EXPECT_TRUE(crossing_edges({{0, 0}, {2, 0}, {1, 0}, {1, 2}}));          // overlaps itself
  EXPECT_TRUE(crossing_edges({{0, 0}, {1, 0}, {2, 0}}));                  // is flat
}

}  // namespace
}  // namespace angen
