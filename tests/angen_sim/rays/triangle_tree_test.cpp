// A heightmap's hits equal those of a mesh of its triangles.
#include "rays/triangle_tree.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace angen::rays::testing {
namespace {

std::shared_ptr<const HeightGrid> rough(std::uint32_t columns, std::uint32_t rows, bool steps) {
  auto grid = std::make_shared<HeightGrid>();
  *grid = {columns, rows, 7.0, 5.0, {}};
  Rng rng(3, 0, 0);
  for (std::uint32_t i = 0; i < columns * rows; ++i) {
    const double height = rng.uniform();
    grid->heights.push_back(static_cast<float>(steps ? std::floor(4 * height) / 4 : height));
  }
  return grid;
}

void expect_same(const TriangleTree& one, const TriangleTree& other, const Vec3& origin,
                 const Vec3& direction, int& hits) {
  double range[2] = {0, 0};
  std::uint32_t triangle[2] = {0, 0};
  const bool hit = one.find_hit(origin, direction, 0.01, 20.0, range[0], triangle[0]);
  ASSERT_EQ(hit, other.find_hit(origin, direction, 0.01, 20.0, range[1], triangle[1]));
  if (!hit) return;
  ++hits;
  ASSERT_EQ(range[0], range[1]);
  ASSERT_EQ(triangle[0], triangle[1]);
  ASSERT_EQ(one.normal(triangle[0]), other.normal(triangle[1]));
}

TEST(TriangleTree, HeightmapMeetsWhatAMeshMeetsBitForBit) {
  for (const bool steps : {false, true}) {
    for (const auto& [columns, rows] : {std::pair{2U, 2U}, {37U, 23U}, {5U, 64U}, {33U, 2U}}) {
      const auto grid = rough(columns, rows, steps);
      const auto heights = TriangleTree::of(grid);
      const auto mesh = TriangleTree::of(mesh_of(*grid));
      EXPECT_EQ(heights->bounds().min(), mesh->bounds().min());
      EXPECT_EQ(heights->bounds().max(), mesh->bounds().max());
      Rng rng(7, 0, 0);
      int hits = 0;
      for (int i = 0; i < 20'000; ++i) {
        const Vec3 origin = random_point(rng, 4.0);
        Vec3 direction = random_point(rng, 1.0);
        if (i % 3 == 0) direction.z() *= 0.02;  // nearly along the ground
        if (i % 5 == 0) direction = Vec3::Unit(i % 3) * (i % 2 == 0 ? 1.0 : -1.0);
        expect_same(*heights, *mesh, origin, direction, hits);
      }
      EXPECT_GT(hits, 1000);
    }
  }
}

// Straight down on vertices, edges and diagonals, where several triangles are equally near.
TEST(TriangleTree, TiesGoToTheSameTriangle) {
  const auto grid = rough(17, 9, true);
  const auto heights = TriangleTree::of(grid);
  const auto mesh = TriangleTree::of(mesh_of(*grid));
  int hits = 0;
  for (std::uint32_t row = 0; row < 9; ++row) {
    for (std::uint32_t column = 0; column < 17; ++column) {
      Vec3 from = grid->vertex(column, row).cast<double>();
      from.z() = 5.0;
      expect_same(*heights, *mesh, from, {0, 0, -1}, hits);
      from.x() += 7.0 / 16 / 2;
      expect_same(*heights, *mesh, from, {0, 0, -1}, hits);
      from.y() -= 5.0 / 8 / 2;
      expect_same(*heights, *mesh, from, {0, 0, -1}, hits);
    }
  }
  EXPECT_GT(hits, 300);
}

TEST(TriangleTree, HeightmapIsInASceneAsAMesh) {
  const auto grid = rough(37, 23, false);
  Scene scenes[2];
  Shape shapes[2];
  shapes[0].type = Shape::Type::kHeightmap;
  shapes[0].heights = grid;
  shapes[1].type = Shape::Type::kMesh;
  shapes[1].mesh = mesh_of(*grid);
  const Pose pose = at(1, 2, 3, from_rpy(0.3, -0.2, 1.1));
  for (int i = 0; i < 2; ++i) {
    scenes[i].add(shapes[i], pose, Mobility::kStatic, Eigen::Vector3f::Ones());
    scenes[i].commit();
  }
  EXPECT_EQ(scenes[0].static_bounds().min(), scenes[1].static_bounds().min());
  Rng rng(11, 0, 0);
  for (int i = 0; i < 5000; ++i) {
    Ray ray{pose * random_point(rng, 4.0), random_point(rng, 1.0)};
    Hit hits[2];
    for (int k = 0; k < 2; ++k) scenes[k].cast(&ray, &hits[k], 1);
    ASSERT_EQ(hits[0].range, hits[1].range);
    ASSERT_EQ(hits[0].normal, hits[1].normal);
  }
}

}  // namespace
}  // namespace angen::rays::testing
