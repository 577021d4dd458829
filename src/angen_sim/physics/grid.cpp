#include "physics/grid.h"

#include <algorithm>
#include <cmath>

namespace angen::physics {

namespace {

constexpr double kCell = 2.0;     // m
constexpr double kMax = 1 << 19;  // cells from the origin; geoms beyond are unbounded
constexpr double kManyCells = 20000.0;

bool cells_of(const Aabb& box, std::array<int, 6>& cells) {
  double count = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double first = std::floor(box.min[i] / kCell);
    const double last = std::floor(box.max[i] / kCell);
    if (!(first > -kMax && last < kMax)) return false;
    count *= last - first + 1.0;
    cells[2 * i] = static_cast<int>(first);
    cells[2 * i + 1] = static_cast<int>(last);
  }
  return count <= kManyCells;
}

// Cheaper than to find its cells: most geoms stay where they are filed.
bool still_in_cells(const Geom& geom) {
  if (!geom.in_grid || geom.unbounded) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const double from_first = geom.box.min[i] - kCell * geom.cells[2 * i];
    const double from_last = geom.box.max[i] - kCell * geom.cells[2 * i + 1];
    if (!(from_first >= 0.0 && from_first < kCell && from_last >= 0.0 && from_last < kCell)) {
      return false;
    }
  }
  return true;
}

void take_out(std::vector<Geom*>& list, const Geom* geom) {
  const auto it = std::find(list.begin(), list.end(), geom);
  if (it == list.end()) return;
  *it = list.back();
  list.pop_back();
}

}  // namespace

void Grid::update(Geom& geom) {
  if (!geom.touches) return erase(geom);
  if (still_in_cells(geom)) return;
  std::array<int, 6> cells{};
  const bool bounded = cells_of(geom.box, cells);
  if (geom.in_grid && geom.unbounded != bounded && (!bounded || cells == geom.cells)) return;
  erase(geom);
  geom.in_grid = true;
  geom.unbounded = !bounded;
  geom.cells = cells;
  if (!bounded) {
    unbounded_.push_back(&geom);
    return;
  }
  for (int x = cells[0]; x <= cells[1]; ++x) {
    for (int y = cells[2]; y <= cells[3]; ++y) {
      for (int z = cells[4]; z <= cells[5]; ++z) cells_[cell_key(x, y, z)].push_back(&geom);
    }
  }
}

void Grid::erase(Geom& geom) {
  if (!geom.in_grid) return;
  geom.in_grid = false;
  geom.shared_cells.clear();
  if (geom.unbounded) {
    take_out(unbounded_, &geom);
    return;
  }
  const auto& c = geom.cells;
  for (int x = c[0]; x <= c[1]; ++x) {
    for (int y = c[2]; y <= c[3]; ++y) {
      for (int z = c[4]; z <= c[5]; ++z) {
        const auto cell = cells_.find(cell_key(x, y, z));
        take_out(cell->second, &geom);
        if (cell->second.empty()) cells_.erase(cell);
      }
    }
  }
}

/// None of them is removed while the geom is in it.
void Grid::find_cells(Geom& geom) {
  const auto& c = geom.cells;
  for (int x = c[0]; x <= c[1]; ++x) {
    for (int y = c[2]; y <= c[3]; ++y) {
      for (int z = c[4]; z <= c[5]; ++z) {
        geom.shared_cells.push_back(&cells_.at(cell_key(x, y, z)));
      }
    }
  }
}

}  // namespace angen::physics
