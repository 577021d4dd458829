#include "rays/triangle_tree.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/kept.h"
#include "rays/device.h"
#include "rays/query.h"
#include "rays/triangle.h"

namespace angen::rays {
namespace {

struct Corners {
  Vec3 a, b, c;
};

/// A primitive of the hierarchy is a triangle.
class MeshTriangles {
 public:
  static constexpr bool kIsPriced = true;

  explicit MeshTriangles(std::shared_ptr<const TriangleMesh> mesh) : mesh_(std::move(mesh)) {}

  std::size_t primitives() const { return mesh_->triangles.size(); }
  Corners corners(std::uint32_t triangle) const {
    const auto& t = mesh_->triangles[triangle];
    return {mesh_->vertices[t[0]].cast<double>(), mesh_->vertices[t[1]].cast<double>(),
            mesh_->vertices[t[2]].cast<double>()};
  }
  Eigen::AlignedBox3d box(std::uint32_t primitive) const {
    const Corners t = corners(primitive);
    return Eigen::AlignedBox3d(t.a).extend(t.b).extend(t.c);
  }
  template <class Test>
  void each_in(std::uint32_t primitive, const Test& test) const {
    test(primitive);
  }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
};

/// A primitive is a block of cells, whose triangles are computed when a ray comes near.
class GridTriangles {
 public:
  static constexpr bool kIsPriced = false;

  explicit GridTriangles(std::shared_ptr<const HeightGrid> grid) : grid_(std::move(grid)) {
    for (std::uint32_t i = 0; i < grid_->columns; ++i) xs_.push_back(grid_->x(i));
    for (std::uint32_t i = 0; i < grid_->rows; ++i) ys_.push_back(grid_->y(i));
    blocks_across_ = (grid_->columns - 2) / kBlock + 1;
  }

  std::size_t primitives() const {
    return std::size_t{blocks_across_} * ((grid_->rows - 2) / kBlock + 1);
  }
  Corners corners(std::uint32_t triangle) const {
    const HeightGrid::Triangle t = grid_->triangle(triangle);
    return {at(t[0].column, t[0].row), at(t[1].column, t[1].row), at(t[2].column, t[2].row)};
  }
  Eigen::AlignedBox3d box(std::uint32_t primitive) const {
    const Block block = block_of(primitive);
    Eigen::AlignedBox3d box;
    for (std::uint32_t row = block.top; row <= block.bottom; ++row) {
      for (std::uint32_t column = block.left; column <= block.right; ++column) {
        box.extend(at(column, row));
      }
    }
    return box;
  }
  template <class Test>
  void each_in(std::uint32_t primitive, const Test& test) const {
    const Block block = block_of(primitive);
    for (std::uint32_t row = block.top; row < block.bottom; ++row) {
      for (std::uint32_t column = block.left; column < block.right; ++column) {
        const std::uint32_t first = grid_->triangle_of(column, row);
        test(first);
        test(first + 1);
      }
    }
  }

 private:
  static constexpr std::uint32_t kBlock = 4;  // cells along a side
  struct Block {
    std::uint32_t left, top, right, bottom;
  };

  Vec3 at(std::uint32_t column, std::uint32_t row) const {
    return {xs_[column], ys_[row], grid_->height(column, row)};
  }
  Block block_of(std::uint32_t primitive) const {
    const std::uint32_t left = primitive % blocks_across_ * kBlock;
    const std::uint32_t top = primitive / blocks_across_ * kBlock;
    return {left, top, std::min(left + kBlock, grid_->columns - 1),
            std::min(top + kBlock, grid_->rows - 1)};
  }

  std::shared_ptr<const HeightGrid> grid_;
  std::vector<float> xs_;  // x of the columns. GCC 12 at -O2 loses the rounding to float otherwise
  std::vector<float> ys_;  // y of the rows
  std::uint32_t blocks_across_ = 0;
};

template <class Triangles>
class TreeOf : public TriangleTree {
 public:
  explicit TreeOf(Triangles triangles) : triangles_(std::move(triangles)) {
    double area = 0.0;
    for (std::uint32_t i = 0; i < triangles_.primitives(); ++i) {
      const Eigen::AlignedBox3d box = triangles_.box(i);
      bounds_.extend(box);
      area += half_surface(box);
    }
    // The mean projected area of a convex solid is a quarter of its surface.
    if (Triangles::kIsPriced && area > 0.0) crossed_ = area / half_surface(bounds_);
    tree_.build(&triangles_, triangles_.primitives());
  }

  bool find_hit(const Vec3& origin, const Vec3& direction, double min, double max, double& range,
                std::uint32_t& triangle) const override {
    Query q{};
    rtcInitIntersectContext(&q.context);
    q.triangles = &triangles_;
    q.origin = origin;
    q.direction = direction;
    q.min = min;
    q.range = max;
    q.triangle = UINT32_MAX;
    RTCRayHit ray{};
    aim(ray.ray, origin, direction, min, max);
    rtcIntersect1(tree_.scene.get(), &q.context, &ray);
    range = q.range;
    triangle = q.triangle;
    return triangle != UINT32_MAX;
  }

  Vec3 normal(std::uint32_t triangle) const override {
    const Corners t = triangles_.corners(triangle);
    return (t.b - t.a).cross(t.c - t.a).normalized();
  }

 private:
  struct Query {
    RTCIntersectContext context;  // first member: Embree returns its address
    const Triangles* triangles;
    Vec3 origin, direction;
    double min, range;
    std::uint32_t triangle;

    void test(std::uint32_t number) {
      double found = 0.0;
      const Corners t = triangles->corners(number);
      if (!intersect_triangle(t.a, t.b, t.c, origin, direction, found)) return;
      if (found < min || found > range || (found == range && number >= triangle)) return;
      range = found;
      triangle = number;
    }
  };

  static void bound(const RTCBoundsFunctionArguments* args) {
    *args->bounds_o =
        padded(static_cast<const Triangles*>(args->geometryUserPtr)->box(args->primID));
  }
  static void intersect(const RTCIntersectFunctionNArguments* args) {
    if (!args->valid[0]) return;
    auto& q = *reinterpret_cast<Query*>(args->context);
    const std::uint32_t before = q.triangle;
    q.triangles->each_in(args->primID, [&](std::uint32_t number) { q.test(number); });
    if (q.triangle != before) {
      reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar = reach(q.range);
    }
  }

  Triangles triangles_;
  Hierarchy tree_{bound, intersect, nullptr};
};

}  // namespace

std::shared_ptr<const TriangleTree> TriangleTree::of(
    const std::shared_ptr<const TriangleMesh>& mesh) {
  static Kept<const TriangleMesh*, const TriangleTree> kept;
  if (!mesh) return nullptr;
  return kept.get(mesh.get(),
                  [&] { return std::make_shared<TreeOf<MeshTriangles>>(MeshTriangles(mesh)); });
}

std::shared_ptr<const TriangleTree> TriangleTree::of(
    const std::shared_ptr<const HeightGrid>& grid) {
  static Kept<const HeightGrid*, const TriangleTree> kept;
  if (!grid || grid->heights.empty()) return nullptr;
  return kept.get(grid.get(),
                  [&] { return std::make_shared<TreeOf<GridTriangles>>(GridTriangles(grid)); });
}

}  // namespace angen::rays
