// A heightmap looks like the mesh of its triangles.
#include <gtest/gtest.h>

#include <cmath>

#include "angen_sim/rays/shapes.h"
#include "render/scene.h"

namespace angen::render {
namespace {

std::shared_ptr<const HeightGrid> waves() {
  auto grid = std::make_shared<HeightGrid>();
  *grid = {51, 41, 8.0, 6.0, {}};
  for (std::uint32_t row = 0; row < 41; ++row) {
    for (std::uint32_t column = 0; column < 51; ++column) {
      grid->heights.push_back(
          static_cast<float>(0.4 * std::sin(0.3 * column) * std::cos(0.2 * row)));
    }
  }
  return grid;
}

Shape as_heightmap(const std::shared_ptr<const HeightGrid>& grid) {
  Shape shape;
  shape.type = Shape::Type::kHeightmap;
  shape.heights = grid;
  return shape;
}

Shape as_mesh(const HeightGrid& grid) {
  Shape shape;
  shape.type = Shape::Type::kMesh;
  shape.mesh = rays::testing::mesh_of(grid);
  return shape;
}

/// A turned body of the shape, with a box on it, under a lamp.
struct Picture {
  Picture(const Shape& ground, bool moves) {
    Body body;
    body.surfaces.push_back({ground,
                             {{0.5, 0, 0.1}, from_rpy(0, 0, 0.3)},
                             {0.6F, 0.5F, 0.4F},
                             Eigen::Vector3f::Zero()});
    body.pose = {{0, 0, 0.2}, from_rpy(0.1, 0, 0)};
    body.moves = moves;
    scene.add(body);
    Body box;
    Shape shape;
    shape.type = Shape::Type::kBox;
    shape.size = {1, 1, 1.5};
    box.surfaces.push_back({shape, Pose{}, {0.2F, 0.2F, 0.8F}, Eigen::Vector3f::Zero()});
    box.pose = {{1.0, 0.5, 0.5}, Quat::Identity()};
    scene.add(box);
    pinhole.width = 120;
    pinhole.height = 90;
    camera = {{-4, -1, 2.5}, from_rpy(0, 0.5, 0.2)};
  }

  std::vector<std::uint8_t> colors() const {
    light::Lit lit;
    lit.lamp.pose.position = {2.5, 2, 4};
    lit.lamp.luminous_flux = 2000;
    lit.level = 1.0;
    return scene.colors(pinhole, camera, {lit}, {});
  }

  PinholeCamera pinhole;
  Scene scene;
  Pose camera;
};

TEST(Heightmap, LooksAsTheMeshOfItsTriangles) {
  const auto grid = waves();
  for (const bool moves : {false, true}) {
    const Picture heights(as_heightmap(grid), moves);
    const Picture mesh(as_mesh(*grid), moves);
    const std::vector<float> depth = heights.scene.depths(heights.pinhole, heights.camera);
    const std::vector<float> expected = mesh.scene.depths(mesh.pinhole, mesh.camera);
    std::size_t seen = 0, other = 0;  // rays along an edge may go either way
    for (std::size_t i = 0; i < depth.size(); ++i) {
      seen += std::isnan(expected[i]) ? 0 : 1;
      other += std::isnan(depth[i]) == std::isnan(expected[i]) &&
                       (std::isnan(depth[i]) || std::abs(depth[i] - expected[i]) < 1e-4F)
                   ? 0
                   : 1;
    }
    EXPECT_GT(seen, 5000U);
    EXPECT_LT(other, 10U);
    const std::vector<std::uint8_t> picture = heights.colors();
    const std::vector<std::uint8_t> same = mesh.colors();
    std::size_t differ = 0, bright = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
      differ += std::abs(picture[i] - same[i]) > 2 ? 1 : 0;
      bright += same[i] > 100 ? 1 : 0;
    }
    EXPECT_GT(bright, 2000U);
    EXPECT_LT(differ, 60U);
  }
}

}  // namespace
}  // namespace angen::render
