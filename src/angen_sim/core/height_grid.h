#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/pose.h"

namespace angen {

/// A surface over a rectangle around the origin: heights (m) row by row from the greatest y, each
/// by rising x. A cell between four of them is two triangles, which are numbered cell by cell.
struct HeightGrid {
  std::uint32_t columns = 0;  // at least 2
  std::uint32_t rows = 0;
  double width = 0.0;  // m along x
  double depth = 0.0;  // m along y
  std::vector<float> heights;

  struct Corner {
    std::uint32_t column = 0;
    std::uint32_t row = 0;
  };
  using Triangle = std::array<Corner, 3>;  // counter-clockwise seen from above

  float height(std::uint32_t column, std::uint32_t row) const {
    return heights[std::size_t{row} * columns + column];
  }
  float x(std::uint32_t column) const {
    return static_cast<float>(width * (static_cast<double>(column) / (columns - 1) - 0.5));
  }
  float y(std::uint32_t row) const {
    return static_cast<float>(depth * (0.5 - static_cast<double>(row) / (rows - 1)));
  }
  Eigen::Vector3f vertex(std::uint32_t column, std::uint32_t row) const {
    return {x(column), y(row), height(column, row)};
  }

  std::uint32_t triangle_of(std::uint32_t column, std::uint32_t row) const {
    return 2 * (row * (columns - 1) + column);
  }
  Triangle triangle(std::uint32_t number) const {
    const std::uint32_t column = number / 2 % (columns - 1);
    const std::uint32_t row = number / 2 / (columns - 1);
    const Corner below{column, row + 1};
    const Corner right{column + 1, row};
    if (number % 2 == 0) return {Corner{column, row}, below, right};
    return {right, below, Corner{column + 1, row + 1}};
  }
};

}  // namespace angen
