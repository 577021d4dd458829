#include "home/grid.h"

#include <gtest/gtest.h>

#include <string>

namespace angen {
namespace {

// '#' is a wall, ' ' is free; the first line has the highest y.
Grid grid_of(const std::vector<std::string>& lines) {
  Grid grid;
  grid.side = 1.0;
  grid.columns = static_cast<int>(lines[0].size());
  grid.rows = static_cast<int>(lines.size());
  for (int row = 0; row < grid.rows; ++row) {
    for (const char c : lines[static_cast<std::size_t>(grid.rows - 1 - row)]) {
      grid.cells.push_back(c == '#' ? Grid::kWall : Grid::kFree);
    }
  }
  return grid;
}

TEST(Grid, PartsAreConnectedByEdges) {
  Grid grid = grid_of({"  # ", " ## ", "#   "});
  const std::vector<std::size_t> sizes = number_parts(grid);
  ASSERT_EQ(sizes.size(), 2U);
  EXPECT_EQ(sizes[0], 5U);  // from the lowest row up
  EXPECT_EQ(sizes[1], 3U);
  EXPECT_EQ(grid.at(3, 2), 0);
  EXPECT_EQ(grid.at(0, 2), 1);
}

TEST(Grid, DistancesToWallsAreOfTheStraightWay) {
  const Grid grid = grid_of({"         ", "         ", "         ", "         ", "#        "});
  const std::vector<double> away = wall_distances(grid, 100.0);
  for (int x = 0; x < grid.columns; ++x) {
    for (int y = 0; y < grid.rows; ++y) {
      const double exact = std::hypot(x, y);
      EXPECT_NEAR(away[grid.index(x, y)], exact, 0.03 * exact) << x << " " << y;
    }
  }
}

TEST(Grid, OutlinesHaveCornersOnlyWhereTheyTurn) {
  Grid grid = grid_of({"#######", "#   ###", "#     #", "# # # #", "#     #", "#######"});
  number_parts(grid);
  const std::vector<Polygon> outlines = outlines_of(grid, 0, 0.1);
  ASSERT_EQ(outlines.size(), 3U);  // and two pillars
  EXPECT_EQ(outlines[0].size(), 6U);
  EXPECT_DOUBLE_EQ(signed_area(outlines[0]), 18.0);
  EXPECT_DOUBLE_EQ(signed_area(outlines[1]), -1.0);
  EXPECT_DOUBLE_EQ(signed_area(outlines[2]), -1.0);
}

TEST(Grid, OutlinesOfSlantedWallsAreStraight) {
  Grid grid;
  grid.side = 0.05;
  grid.columns = grid.rows = 100;
  grid.cells.assign(10'000, Grid::kWall);
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column + row < 100; ++column) grid.at(column, row) = 0;
  }
  const std::vector<Polygon> outlines = outlines_of(grid, 0, 0.08);
  ASSERT_EQ(outlines.size(), 1U);
  EXPECT_LE(outlines[0].size(), 5U);
  EXPECT_NEAR(signed_area(outlines[0]), 12.5, 0.5);
}

TEST(Grid, LabelsGrowToTheNearestFreeSquares) {
  Grid grid = grid_of({"     #  "});
  grid.at(0, 0) = 0;
  grid.at(4, 0) = 1;
  grow_labels(grid);
  EXPECT_EQ(grid.cells, (std::vector<std::int32_t>{0, 0, 0, 1, 1, -1, -2, -2}));
}

}  // namespace
}  // namespace angen
