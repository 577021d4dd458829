#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/polygon.h"

namespace angen {

/// A raster: the square cells of a plane, each with a number. Row 0 has the lowest y.
struct Grid {
  static constexpr std::int32_t kWall = -1;
  static constexpr std::int32_t kFree = -2;

  Point2 origin = Point2::Zero();  // m, of the outer corner of cell 0, 0
  double side = 0.05;              // m
  int columns = 0;
  int rows = 0;
  int floor = 0;                    // the number of a storey
  double height = 0.0;              // z of that floor
  std::vector<std::int32_t> cells;  // by row and column

  std::int32_t& at(int column, int row) { return cells[index(column, row)]; }
  std::int32_t at(int column, int row) const { return cells[index(column, row)]; }
  bool has(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns && row < rows;
  }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  Point2 middle(int column, int row) const {
    return origin + side * Point2(column + 0.5, row + 0.5);
  }
  /// The cell of a point, {column, row}; it may be beyond the raster.
  std::pair<int, int> cell(const Point2& point) const;
  /// Sets the cells whose middles a polygon contains.
  void fill(const Polygon& polygon, std::int32_t value);
};

/// A part of a raster as polygons, m: counterclockwise, holes clockwise.
struct Region {
  Polygon outline;
  std::vector<Polygon> holes;
};

/// Numbers the connected parts of the free cells from 0, and returns their sizes in cells.
std::vector<std::size_t> number_parts(Grid& grid);

/// m from each cell to the nearest wall, at most `most`.
std::vector<double> wall_distances(const Grid& grid, double most);

/// Gives free cells the label of the nearest labeled cell that they are connected to.
void grow_labels(Grid& grid);

/// The edges of a label's cells: outlines are counterclockwise, those of holes clockwise. Each
/// begins at its lowest corner. Corners off a straight line by less than `tolerance` (m) are left
/// out.
std::vector<Polygon> outlines_of(const Grid& grid, std::int32_t label, double tolerance);

/// The largest outline of a label and its holes of more than `least` (m^2); none without a cell.
std::optional<Region> region_of(const Grid& grid, std::int32_t label, double tolerance,
                                double least);

}  // namespace angen
