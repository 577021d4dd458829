#include "rays/height_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "rays/triangle.h"

namespace angen::rays {
namespace {

constexpr std::uint32_t kBlock = 4;  // cells along a side of the smallest blocks
constexpr double kPad = 1e-9;        // share of the extent

/// Whether the ray is inside the box anywhere in [min, max].
bool crosses(const Eigen::AlignedBox3d& box, const Vec3& origin, const Vec3& direction, double min,
             double max) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < 1e-300) {
      if (origin[axis] < box.min()[axis] || origin[axis] > box.max()[axis]) return false;
      continue;
    }
    const double inverse = 1.0 / direction[axis];
    const double a = (box.min()[axis] - origin[axis]) * inverse;
    const double b = (box.max()[axis] - origin[axis]) * inverse;
    min = std::max(min, std::min(a, b));
    max = std::min(max, std::max(a, b));
    if (!(min <= max)) return false;
  }
  return true;
}

}  // namespace

struct HeightTree::Query {
  Vec3 origin, direction;
  double min, range;
  std::uint32_t triangle;

  void test(const HeightTree& tree, std::uint32_t number) {
    const HeightGrid::Triangle t = tree.grid_->triangle(number);
    double found = 0.0;
    if (!intersect_triangle(tree.corner(t[0]), tree.corner(t[1]), tree.corner(t[2]), origin,
                            direction, found)) {
      return;
    }
    if (found < min || found > range || (found == range && number >= triangle)) return;
    range = found;
    triangle = number;
  }
};

HeightTree::HeightTree(std::shared_ptr<const HeightGrid> grid) : grid_(std::move(grid)) {
  for (std::uint32_t column = 0; column < grid_->columns; ++column) xs_.push_back(grid_->x(column));
  for (std::uint32_t row = 0; row < grid_->rows; ++row) ys_.push_back(grid_->y(row));
  add_first_level();
  while (levels_.back().blocks.size() > 1) add_level();
  bounds_ = box(0, 0, std::max(grid_->columns, grid_->rows), levels_.back().blocks[0]);
  pad_ = kPad * (1.0 + bounds_.min().cwiseAbs().cwiseMax(bounds_.max().cwiseAbs()).maxCoeff());
}

std::shared_ptr<const HeightTree> HeightTree::of(const std::shared_ptr<const HeightGrid>& grid) {
  static std::mutex mutex;
  static std::map<const HeightGrid*, std::weak_ptr<const HeightTree>> kept;
  if (!grid || grid->heights.empty()) return nullptr;
  const std::lock_guard<std::mutex> lock(mutex);
  for (auto it = kept.begin(); it != kept.end();) {
    it = it->second.expired() ? kept.erase(it) : std::next(it);
  }
  if (auto found = kept[grid.get()].lock()) return found;
  auto tree = std::make_shared<const HeightTree>(grid);
  kept[grid.get()] = tree;
  return tree;
}

void HeightTree::add_first_level() {
  Level level{kBlock, (grid_->columns - 2) / kBlock + 1, (grid_->rows - 2) / kBlock + 1, {}};
  for (std::uint32_t row = 0; row < level.rows; ++row) {
    for (std::uint32_t column = 0; column < level.columns; ++column) {
      const std::uint32_t last_row = std::min((row + 1) * kBlock, grid_->rows - 1);
      const std::uint32_t last_column = std::min((column + 1) * kBlock, grid_->columns - 1);
      const float first = grid_->height(column * kBlock, row * kBlock);
      Range range{first, first};
      for (std::uint32_t r = row * kBlock; r <= last_row; ++r) {
        for (std::uint32_t c = column * kBlock; c <= last_column; ++c) {
          range.low = std::min(range.low, grid_->height(c, r));
          range.high = std::max(range.high, grid_->height(c, r));
        }
      }
      level.blocks.push_back(range);
    }
  }
  levels_.push_back(std::move(level));
}

void HeightTree::add_level() {
  const Level& fine = levels_.back();
  Level level{2 * fine.side, (fine.columns + 1) / 2, (fine.rows + 1) / 2, {}};
  for (std::uint32_t row = 0; row < level.rows; ++row) {
    for (std::uint32_t column = 0; column < level.columns; ++column) {
      Range range = fine.blocks[std::size_t{2} * (std::size_t{row} * fine.columns + column)];
      for (std::uint32_t r = 2 * row; r < std::min(2 * row + 2, fine.rows); ++r) {
        for (std::uint32_t c = 2 * column; c < std::min(2 * column + 2, fine.columns); ++c) {
          const Range& part = fine.blocks[std::size_t{r} * fine.columns + c];
          range.low = std::min(range.low, part.low);
          range.high = std::max(range.high, part.high);
        }
      }
      level.blocks.push_back(range);
    }
  }
  levels_.push_back(std::move(level));
}

Eigen::AlignedBox3d HeightTree::box(std::uint32_t column, std::uint32_t row, std::uint32_t side,
                                    const Range& heights) const {
  const double left = xs_[column];
  const double right = xs_[std::min(column + side, grid_->columns - 1)];
  const double top = ys_[row];
  const double bottom = ys_[std::min(row + side, grid_->rows - 1)];
  return {Vec3(left - pad_, bottom - pad_, heights.low - pad_),
          Vec3(right + pad_, top + pad_, heights.high + pad_)};
}

void HeightTree::visit(std::size_t level, std::uint32_t column, std::uint32_t row, Query& q) const {
  const Level& here = levels_[level];
  if (column >= here.columns || row >= here.rows) return;
  const Range& heights = here.blocks[std::size_t{row} * here.columns + column];
  const Eigen::AlignedBox3d around = box(column * here.side, row * here.side, here.side, heights);
  if (!crosses(around, q.origin, q.direction, q.min, q.range)) return;
  if (level == 0) {
    visit_cells(column * kBlock, row * kBlock, q);
    return;
  }
  // Nearer blocks first: a hit in them excludes the others.
  const std::uint32_t near_column = q.direction.x() >= 0.0 ? 0 : 1;
  const std::uint32_t near_row = q.direction.y() >= 0.0 ? 1 : 0;  // y falls with the row
  for (std::uint32_t i = 0; i < 4; ++i) {
    visit(level - 1, 2 * column + (near_column ^ (i & 1U)), 2 * row + (near_row ^ (i >> 1U)), q);
  }
}

void HeightTree::visit_cells(std::uint32_t column, std::uint32_t row, Query& q) const {
  const std::uint32_t last_row = std::min(row + kBlock, grid_->rows - 1);
  const std::uint32_t last_column = std::min(column + kBlock, grid_->columns - 1);
  for (std::uint32_t r = row; r < last_row; ++r) {
    for (std::uint32_t c = column; c < last_column; ++c) {
      const float a = grid_->height(c, r), b = grid_->height(c + 1, r);
      const float d = grid_->height(c, r + 1), e = grid_->height(c + 1, r + 1);
      const Range heights{std::min({a, b, d, e}), std::max({a, b, d, e})};
      if (!crosses(box(c, r, 1, heights), q.origin, q.direction, q.min, q.range)) continue;
      const std::uint32_t number = grid_->triangle_of(c, r);
      q.test(*this, number);
      q.test(*this, number + 1);
    }
  }
}

bool HeightTree::find_hit(const Vec3& origin, const Vec3& direction, double min, double max,
                          double& range, std::uint32_t& triangle) const {
  Query q{origin, direction, min, max, UINT32_MAX};
  visit(levels_.size() - 1, 0, 0, q);
  range = q.range;
  triangle = q.triangle;
  return triangle != UINT32_MAX;
}

Vec3 HeightTree::normal(std::uint32_t triangle) const {
  const HeightGrid::Triangle t = grid_->triangle(triangle);
  const Vec3 a = corner(t[0]);
  return (corner(t[1]) - a).cross(corner(t[2]) - a).normalized();
}

}  // namespace angen::rays
