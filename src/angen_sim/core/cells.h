#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace angen {

/// Cells up to this distance from the origin, in cells along each axis, have unique keys.
constexpr int kCellLimit = 1 << 20;

/// A cell of a regular lattice as one number.
inline std::uint64_t cell_key(int x, int y, int z) {
  const auto part = [](int v) { return static_cast<std::uint64_t>(v + kCellLimit) & 0x1fffff; };
  return part(x) << 42 | part(y) << 21 | part(z);
}

/// The first and the last cell along x, y, z that a box overlaps.
using CellRange = std::array<int, 6>;

/// Finds the cells of a side that a box overlaps. False if there are more than `most`, or if one is
/// `limit` cells or more from the origin.
template <class Point>
bool find_cells(const Point& low, const Point& high, double side, double limit, double most,
                CellRange& cells) {
  double count = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(2 * axis);
    const double first = std::floor(low[axis] / side);
    const double last = std::floor(high[axis] / side);
    if (!(first > -limit && last < limit)) return false;
    count *= last - first + 1.0;
    cells[at] = static_cast<int>(first);
    cells[at + 1] = static_cast<int>(last);
  }
  return count <= most;
}

/// Calls visit(key) for each of the cells.
template <class F>
void each_cell(const CellRange& cells, F&& visit) {
  for (int x = cells[0]; x <= cells[1]; ++x) {
    for (int y = cells[2]; y <= cells[3]; ++y) {
      for (int z = cells[4]; z <= cells[5]; ++z) visit(cell_key(x, y, z));
    }
  }
}

}  // namespace angen
