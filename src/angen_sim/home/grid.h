#pragma once

#include <cstdint>
#include <vector>

#include "core/polygon.h"

namespace angen {

/// Squares of a plane, each with a number.
struct LabelGrid {
  static constexpr std::int32_t kWall = -1;
  static constexpr std::int32_t kFree = -2;

  Point2 origin = Point2::Zero();  // m, of the corner of square 0, 0
  double side = 0.05;              // m
  int columns = 0;
  int rows = 0;
  std::vector<std::int32_t> labels;  // by row and column

  std::int32_t& at(int column, int row) { return labels[index(column, row)]; }
  std::int32_t at(int column, int row) const { return labels[index(column, row)]; }
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
};

/// Numbers the connected parts of the free squares from 0, and returns their sizes in squares.
std::vector<std::size_t> number_parts(LabelGrid& grid);

/// m from each square to the nearest wall, at most `most`.
std::vector<double> wall_distances(const LabelGrid& grid, double most);

/// Gives free squares the label of the nearest labeled square that they are connected to.
void grow_labels(LabelGrid& grid);

/// The edges of a label's squares: outlines are counterclockwise, those of holes clockwise. Corners
/// off a straight line by less than `tolerance` (m) are left out.
std::vector<Polygon> outlines_of(const LabelGrid& grid, std::int32_t label, double tolerance);

}  // namespace angen
