#include "physics/height_tiles.h"

#include <algorithm>
#include <cmath>

namespace angen::physics {
namespace {

constexpr std::uint32_t kCells = 16;     // along a side of a tile
constexpr std::size_t kMaxTiles = 4096;  // tiles that are kept, of some 50 kB each

std::uint32_t tiles_along(std::uint32_t count) { return (count - 2) / kCells + 1; }

}  // namespace

void HeightTiles::Mesh::build() {
  data.reset(dGeomTriMeshDataCreate());
  dGeomTriMeshDataBuildSingle(data.get(), vertices.data(), sizeof(vertices[0]),
                              static_cast<int>(vertices.size()), triangles.data(),
                              static_cast<int>(3 * triangles.size()), sizeof(triangles[0]));
}

HeightTiles::HeightTiles(std::shared_ptr<const HeightGrid> grid) : grid_(std::move(grid)) {
  const auto [low, high] = std::minmax_element(grid_->heights.begin(), grid_->heights.end());
  for (std::uint32_t i = 0; i < 8; ++i) {
    bounds_.vertices.emplace_back(grid_->x((i & 1U) != 0 ? grid_->columns - 1 : 0),
                                  grid_->y((i & 2U) != 0 ? 0 : grid_->rows - 1),
                                  (i & 4U) != 0 ? *high : *low);
  }
  bounds_.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  bounds_.build();
}

// Coordinates run from -size / 2 on, over `count` lines.
HeightTiles::Span HeightTiles::span(double from, double to, double size, std::uint32_t count) {
  const double tiles = tiles_along(count);
  const double cells = (count - 1) / size;
  const double first = std::floor((from + size / 2) * cells / kCells - 1e-6);
  const double last = std::floor((to + size / 2) * cells / kCells + 1e-6);
  return {static_cast<std::uint32_t>(std::clamp(first, 0.0, tiles)),
          static_cast<std::uint32_t>(std::clamp(last + 1.0, 0.0, tiles))};
}

dTriMeshDataID HeightTiles::tile(std::uint32_t column, std::uint32_t row,
                                 const Eigen::AlignedBox3d& box) {
  auto known = tiles_.find({column, row});
  if (known == tiles_.end()) {
    if (tiles_.size() >= kMaxTiles) tiles_.clear();
    known = tiles_.emplace(std::make_pair(column, row), make(column, row)).first;
  }
  Mesh& mesh = known->second;
  if (box.min().z() > mesh.high || box.max().z() < mesh.low) return nullptr;
  if (!mesh.data) mesh.build();
  return mesh.data.get();
}

HeightTiles::Mesh HeightTiles::make(std::uint32_t column, std::uint32_t row) const {
  const std::uint32_t left = column * kCells, top = row * kCells;
  const std::uint32_t right = std::min(left + kCells, grid_->columns - 1);
  const std::uint32_t bottom = std::min(top + kCells, grid_->rows - 1);
  const std::uint32_t across = right - left + 1;
  Mesh mesh;
  mesh.low = mesh.high = grid_->height(left, top);
  for (std::uint32_t r = top; r <= bottom; ++r) {
    for (std::uint32_t c = left; c <= right; ++c) {
      mesh.vertices.push_back(grid_->vertex(c, r));
      mesh.low = std::min(mesh.low, mesh.vertices.back().z());
      mesh.high = std::max(mesh.high, mesh.vertices.back().z());
    }
  }
  for (std::uint32_t r = top; r < bottom; ++r) {
    for (std::uint32_t c = left; c < right; ++c) {
      const std::uint32_t a = (r - top) * across + c - left;
      mesh.triangles.push_back({a, a + across, a + 1});
      mesh.triangles.push_back({a + 1, a + across, a + across + 1});
    }
  }
  return mesh;
}

}  // namespace angen::physics
