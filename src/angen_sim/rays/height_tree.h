#pragma once

#include <memory>
#include <vector>

#include "core/height_grid.h"
#include "rays/triangle_tree.h"

namespace angen::rays {

/// The triangles of a heightmap, computed when a ray comes near. Stores only the range of heights
/// of each block of cells, of four such blocks, and so on.
class HeightTree : public TriangleTree {
 public:
  explicit HeightTree(std::shared_ptr<const HeightGrid> grid);

  /// The shared tree of a grid, kept while it is used; null if the grid has no heights.
  static std::shared_ptr<const HeightTree> of(const std::shared_ptr<const HeightGrid>& grid);

  bool find_hit(const Vec3& origin, const Vec3& direction, double min, double max, double& range,
                std::uint32_t& triangle) const override;
  Vec3 normal(std::uint32_t triangle) const override;

 private:
  struct Range {
    float low = 0.0F;
    float high = 0.0F;
  };
  struct Level {  // blocks of `side` by `side` cells
    std::uint32_t side = 0;
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::vector<Range> blocks;
  };
  struct Query;

  Vec3 corner(HeightGrid::Corner at) const {
    return {xs_[at.column], ys_[at.row], grid_->height(at.column, at.row)};
  }
  void add_first_level();
  void add_level();
  Eigen::AlignedBox3d box(std::uint32_t column, std::uint32_t row, std::uint32_t side,
                          const Range& heights) const;
  void visit(std::size_t level, std::uint32_t column, std::uint32_t row, Query& q) const;
  void visit_cells(std::uint32_t column, std::uint32_t row, Query& q) const;

  std::shared_ptr<const HeightGrid> grid_;
  std::vector<float> xs_;  // x of the columns. GCC 12 at -O2 loses the rounding to float otherwise
  std::vector<float> ys_;  // y of the rows
  double pad_ = 0.0;       // m, more than rounding can move a ray or a box
  std::vector<Level> levels_;  // the last has one block
};

}  // namespace angen::rays
