#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/height_grid.h"
#include "physics/ode.h"

namespace angen::physics {

/// A heightmap for ODE: meshes of small tiles, made when a body comes near them. The contacts
/// do not depend on which tiles exist.
class HeightTiles {
 public:
  explicit HeightTiles(std::shared_ptr<const HeightGrid> grid);

  /// The box around all of it, as a mesh.
  dTriMeshDataID bounds() const { return bounds_.data.get(); }

  /// Calls touch(tile) with the mesh of each tile that overlaps the box, in the heightmap's frame.
  template <class F>
  void each_in(const Eigen::AlignedBox3d& box, F&& touch) {
    const Span columns = span(box.min().x(), box.max().x(), grid_->width, grid_->columns);
    const Span rows = span(-box.max().y(), -box.min().y(), grid_->depth, grid_->rows);
    for (std::uint32_t row = rows.first; row < rows.end; ++row) {
      for (std::uint32_t column = columns.first; column < columns.end; ++column) {
        if (dTriMeshDataID found = tile(column, row, box)) touch(found);
      }
    }
  }

 private:
  struct Mesh {
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    ode::MeshHandle data;
    float low = 0.0F;
    float high = 0.0F;

    void build();
  };
  struct Span {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
  };

  static Span span(double from, double to, double size, std::uint32_t count);
  dTriMeshDataID tile(std::uint32_t column, std::uint32_t row, const Eigen::AlignedBox3d& box);
  Mesh make(std::uint32_t column, std::uint32_t row) const;

  std::shared_ptr<const HeightGrid> grid_;
  Mesh bounds_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Mesh> tiles_;
};

}  // namespace angen::physics
