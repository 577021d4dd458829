#include "physics/grid.h"

#include <algorithm>

#include "core/cells.h"

namespace angen::physics {

namespace {

constexpr double kCell = 2.0;     // m
constexpr double kMax = 1 << 19;  // cells from the origin; geoms beyond are unbounded
constexpr double kManyCells = 20000.0;

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
  CellRange cells{};
  const bool bounded =
      angen::find_cells(geom.box.min, geom.box.max, kCell, kMax, kManyCells, cells);
  if (geom.in_grid && geom.unbounded != bounded && (!bounded || cells == geom.cells)) return;
  erase(geom);
  geom.in_grid = true;
  geom.unbounded = !bounded;
  geom.cells = cells;
  if (!bounded) {
    unbounded_.push_back(&geom);
    return;
  }
  each_cell(cells, [&](std::uint64_t key) { cells_[key].push_back(&geom); });
}

void Grid::erase(Geom& geom) {
  if (!geom.in_grid) return;
  geom.in_grid = false;
  geom.shared_cells.clear();
  if (geom.unbounded) {
    take_out(unbounded_, &geom);
    return;
  }
  each_cell(geom.cells, [&](std::uint64_t key) {
    const auto cell = cells_.find(key);
    take_out(cell->second, &geom);
    if (cell->second.empty()) cells_.erase(cell);
  });
}

/// None of them is removed while the geom is in it.
void Grid::find_cells(Geom& geom) {
  each_cell(geom.cells, [&](std::uint64_t key) { geom.shared_cells.push_back(&cells_.at(key)); });
}

}  // namespace angen::physics
