#include "home/grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <tuple>
#include <unordered_map>

namespace angen {

namespace {

constexpr std::array<std::pair<int, int>, 4> kNeighbors = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

double distance_to_line(const Point2& point, const Point2& from, const Point2& to) {
  const Point2 along = to - from;
  if (along.norm() < 1e-12) return (point - from).norm();
  return std::abs(along.x() * (point.y() - from.y()) - along.y() * (point.x() - from.x())) /
         along.norm();
}

// Douglas and Peucker's, of corners first to last.
void keep_corners(const Polygon& all, std::size_t first, std::size_t last, double tolerance,
                  std::vector<bool>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> left = {{first, last}};
  while (!left.empty()) {
    const auto [from, to] = left.back();
    left.pop_back();
    std::size_t farthest = from;
    double most = tolerance;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double away = distance_to_line(all[i], all[from], all[to % all.size()]);
      if (away <= most) continue;
      most = away;
      farthest = i;
    }
    if (farthest == from) continue;
    kept[farthest] = true;
    left.emplace_back(from, farthest);
    left.emplace_back(farthest, to);
  }
}

// The corners of cells in m, from the lowest one on.
Polygon outline_from(std::vector<std::pair<int, int>> corners, const Grid& grid) {
  const auto lowest =
      std::min_element(corners.begin(), corners.end(), [](const auto& a, const auto& b) {
        return std::tie(a.second, a.first) < std::tie(b.second, b.first);
      });
  std::rotate(corners.begin(), lowest, corners.end());
  Polygon outline;
  for (const auto& [x, y] : corners) outline.push_back(grid.origin + grid.side * Point2(x, y));
  return outline;
}

Polygon simplified(const Polygon& all, double tolerance) {
  std::size_t opposite = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if ((all[i] - all[0]).norm() > (all[opposite] - all[0]).norm()) opposite = i;
  }
  std::vector<bool> kept(all.size(), false);
  kept[0] = kept[opposite] = true;
  keep_corners(all, 0, opposite, tolerance, kept);
  keep_corners(all, opposite, all.size(), tolerance, kept);
  Polygon left;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (kept[i]) left.push_back(all[i]);
  }
  return left;
}

}  // namespace

std::pair<int, int> Grid::cell(const Point2& point) const {
  const Point2 cells_away = ((point - origin) / side).array().floor();
  return {static_cast<int>(cells_away.x()), static_cast<int>(cells_away.y())};
}

// A middle is inside where the number of edges on its right is odd.
void Grid::fill(const Polygon& polygon, std::int32_t value) {
  Eigen::AlignedBox2d around;
  for (const Point2& corner : polygon) around.extend(corner);
  if (around.isEmpty()) return;
  const int last_row = std::min(rows - 1, cell(around.max()).second);
  std::vector<double> crossed;
  for (int row = std::max(0, cell(around.min()).second); row <= last_row; ++row) {
    const double y = middle(0, row).y();
    crossed.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point2& from = polygon[i];
      const Point2& to = polygon[(i + 1) % polygon.size()];
      if ((from.y() > y) == (to.y() > y)) continue;
      crossed.push_back((to.x() - from.x()) * (y - from.y()) / (to.y() - from.y()) + from.x());
    }
    std::sort(crossed.begin(), crossed.end());
    for (std::size_t i = 0; i + 1 < crossed.size(); i += 2) {
      int column = std::max(0, cell({crossed[i], y}).first - 1);
      while (column < columns && middle(column, row).x() < crossed[i]) ++column;
      for (; column < columns && middle(column, row).x() < crossed[i + 1]; ++column) {
        at(column, row) = value;
      }
    }
  }
}

std::vector<std::size_t> number_parts(Grid& grid) {
  std::vector<std::size_t> sizes;
  std::vector<std::pair<int, int>> left;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (grid.at(column, row) != Grid::kFree) continue;
      const auto label = static_cast<std::int32_t>(sizes.size());
      sizes.push_back(0);
      grid.at(column, row) = label;
      left = {{column, row}};
      while (!left.empty()) {
        const auto [x, y] = left.back();
        left.pop_back();
        ++sizes.back();
        for (const auto& [dx, dy] : kNeighbors) {
          if (!grid.has(x + dx, y + dy) || grid.at(x + dx, y + dy) != Grid::kFree) continue;
          grid.at(x + dx, y + dy) = label;
          left.emplace_back(x + dx, y + dy);
        }
      }
    }
  }
  return sizes;
}

std::vector<double> wall_distances(const Grid& grid, double most) {
  // Two passes of distances to neighbors, as in a chamfer: 2 % too long at most.
  constexpr std::array<std::array<int, 2>, 8> kBefore = {
      {{-1, 0}, {0, -1}, {-1, -1}, {1, -1}, {-2, -1}, {2, -1}, {-1, -2}, {1, -2}}};
  std::vector<double> away(grid.cells.size(), most);
  for (std::size_t i = 0; i < away.size(); ++i) {
    if (grid.cells[i] == Grid::kWall) away[i] = 0.0;
  }
  const auto pass = [&](int column, int row, int sign) {
    double& here = away[grid.index(column, row)];
    for (const auto& [dx, dy] : kBefore) {
      const int x = column + sign * dx;
      const int y = row + sign * dy;
      if (!grid.has(x, y)) continue;
      here = std::min(here, away[grid.index(x, y)] + grid.side * std::hypot(dx, dy));
    }
  };
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) pass(column, row, 1);
  }
  for (int row = grid.rows; row-- > 0;) {
    for (int column = grid.columns; column-- > 0;) pass(column, row, -1);
  }
  return away;
}

void grow_labels(Grid& grid) {
  std::deque<std::pair<int, int>> left;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (grid.at(column, row) >= 0) left.emplace_back(column, row);
    }
  }
  while (!left.empty()) {
    const auto [x, y] = left.front();
    left.pop_front();
    for (const auto& [dx, dy] : kNeighbors) {
      if (!grid.has(x + dx, y + dy) || grid.at(x + dx, y + dy) != Grid::kFree) continue;
      grid.at(x + dx, y + dy) = grid.at(x, y);
      left.emplace_back(x + dx, y + dy);
    }
  }
}

std::vector<Polygon> outlines_of(const Grid& grid, std::int32_t label, double tolerance) {
  const auto inside = [&](int column, int row) {
    return grid.has(column, row) && grid.at(column, row) == label;
  };
  // Edges with the label on their left, by the corner that they begin at.
  using Corner = std::pair<int, int>;
  struct Edge {
    Corner from;
    int way = 0;  // in kNeighbors
    bool used = false;
  };
  std::vector<Edge> edges;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (!inside(column, row)) continue;
      if (!inside(column, row - 1)) edges.push_back({{column, row}, 0});
      if (!inside(column + 1, row)) edges.push_back({{column + 1, row}, 1});
      if (!inside(column, row + 1)) edges.push_back({{column + 1, row + 1}, 2});
      if (!inside(column - 1, row)) edges.push_back({{column, row + 1}, 3});
    }
  }
  std::unordered_map<std::size_t, std::vector<std::size_t>> from;
  const auto key = [&](const Corner& corner) {
    return static_cast<std::size_t>(corner.second) * static_cast<std::size_t>(grid.columns + 1) +
           static_cast<std::size_t>(corner.first);
  };
  for (std::size_t i = 0; i < edges.size(); ++i) from[key(edges[i].from)].push_back(i);
  std::vector<Polygon> outlines;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (edges[start].used) continue;
    std::vector<Corner> corners;
    int before = -1;
    std::size_t at = start;
    do {
      Edge& edge = edges[at];
      edge.used = true;
      if (edge.way != before) corners.push_back(edge.from);
      before = edge.way;
      const auto& [dx, dy] = kNeighbors[static_cast<std::size_t>(edge.way)];
      const Corner end{edge.from.first + dx, edge.from.second + dy};
      // The outline turns left at a corner where two squares touch: they are apart.
      std::size_t next = edges.size();
      for (const std::size_t i : from[key(end)]) {
        if (edges[i].used && i != start) continue;
        const bool left = edges[i].way == (edge.way + 1) % 4;
        if (next == edges.size() || left) next = i;
      }
      at = next;
    } while (at != start && at != edges.size());
    if (edges[start].way == before) corners.erase(corners.begin());  // it is on a straight line
    outlines.push_back(simplified(outline_from(std::move(corners), grid), tolerance));
  }
  return outlines;
}

std::optional<Region> region_of(const Grid& grid, std::int32_t label, double tolerance,
                                double least) {
  Region region;
  for (Polygon& outline : outlines_of(grid, label, tolerance)) {
    if (outline.size() < 3) continue;
    const double area = signed_area(outline);
    if (area > 0.0 && (region.outline.empty() || area > signed_area(region.outline))) {
      region.outline = std::move(outline);
    } else if (area < -least) {
      region.holes.push_back(std::move(outline));
    }
  }
  if (region.outline.empty()) return std::nullopt;
  return region;
}

}  // namespace angen
