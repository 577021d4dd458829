#include "render/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/texture.h"
#include "scene_view.h"

namespace angen::render {
namespace {

TEST(Picture, ABoxCoversThePixelsOfThePinholeFormula) {
  View view;
  view.scene.add(body(box(1.0, 1.0, 0.6), at(2.5)));  // its face is 2 m away
  const std::vector<float> depths = view.scene.depths(view.pinhole, view.camera);
  const double focal = 160.0 / std::tan(0.5 * view.pinhole.horizontal_angle);
  for (int row = 0; row < 240; ++row) {
    for (int column = 0; column < 320; ++column) {
      const double left = std::abs(column - 159.5) / focal * 2.0;
      const double up = std::abs(row - 119.5) / focal * 2.0;
      const bool inside = left < 0.5 && up < 0.3;
      const float depth = depths[static_cast<std::size_t>(row * 320 + column)];
      EXPECT_EQ(!std::isnan(depth), inside) << column << ", " << row;
      if (inside) {
        EXPECT_NEAR(depth, 2.0, 1e-4);
      }
    }
  }
}

TEST(Picture, DepthsAfterAPictureInColorAreThoseOfTheSceneNow) {
  View view;
  const BodyId wall = view.scene.add(body(box(1.0, 100.0, 100.0), at(3.5)));
  const std::vector<float> alone = view.scene.depths(view.pinhole, view.camera);
  view.color(0, 0, {}, kDim);
  EXPECT_EQ(view.scene.depths(view.pinhole, view.camera), alone);
  PinholeCamera narrow = view.pinhole;
  narrow.far = 2.0;
  EXPECT_TRUE(std::isnan(view.scene.depths(narrow, view.camera)[0]));
  EXPECT_NEAR(view.scene.depths(view.pinhole, at(1.0))[0], 2.0, 1e-4);
  view.color(0, 0, {}, kDim);
  view.scene.move(wall, at(4.5));
  EXPECT_NEAR(view.depth(0, 0), 4.0, 1e-4);
  view.color(0, 0, {}, kDim);
  view.scene.add(body(box(1.0, 100.0, 100.0), at(2.5)));
  EXPECT_NEAR(view.depth(0, 0), 2.0, 1e-4);
}

TEST(Picture, ACameraInItsOwnHousingSeesWhatIsBeyond) {
  View view;
  view.scene.add(body(box(0.2, 0.3, 0.2), at(0.05)));
  view.scene.add(body(round(Shape::Type::kCylinder, 0.3, 0.4), at(0.0)));
  EXPECT_TRUE(std::isnan(view.depth(160, 120)));
  view.scene.add(body(box(1.0, 9.0, 9.0), at(2.5)));
  EXPECT_NEAR(view.depth(160, 120), 2.0, 1e-4);
  EXPECT_NEAR(view.depth(3, 200), 2.0, 1e-4);
  view.scene.add(body(box(0.1, 0.1, 0.1), at(0.45)));  // in front of the housing
  EXPECT_NEAR(view.depth(160, 120), 0.4, 1e-4);
}

// The edge of a thing in the housing is between two pixels of a tile, at each place in it.
TEST(Picture, AThingInTheHousingIsSeenBesideWhatIsBeyond) {
  View view;
  view.scene.add(body(box(0.2, 0.3, 0.2), at(0.05)));
  view.scene.add(body(box(1.0, 9.0, 9.0), at(2.5)));
  const BodyId thing = view.scene.add(body(box(2e-4, 0.1, 0.1), at(0.0601, 0.05)));
  for (int column = 150; column < 170; ++column) {  // the first that is beside it
    const double edge = 0.06 * (view.pinhole.center_x() - (column - 0.5)) / view.pinhole.focal();
    view.scene.move(thing, at(0.0601, edge + 0.05));
    EXPECT_NEAR(view.depth(column - 1, 120), 0.06, 1e-4) << column;
    EXPECT_NEAR(view.depth(column, 120), 2.0, 1e-4) << column;
  }
}

TEST(Picture, WallsOfARoomAreSeenFromInside) {
  View view;
  view.scene.add(body(box(4.0, 4.0, 4.0), at(0.0)));
  EXPECT_NEAR(view.depth(160, 120), 2.0, 1e-4);
}

TEST(Picture, DepthOfAWallIsAlongTheAxisNotTheRay) {
  View view;
  view.camera = {{1.0, 2.0, 3.0}, from_rpy(0.0, 0.0, M_PI_2)};
  view.scene.add(body(box(100.0, 1.0, 100.0), at(1.0, 6.5, 3.0)));
  for (const float depth : view.scene.depths(view.pinhole, view.camera)) {
    ASSERT_NEAR(depth, 4.0, 1e-4);
  }
}

TEST(Picture, DepthOfABallFollowsItsEquation) {
  View view;
  view.scene.add(body(round(Shape::Type::kSphere, 0.5), at(2.0)));
  const std::vector<float> depths = view.scene.depths(view.pinhole, view.camera);
  int seen = 0;
  for (int row = 0; row < 240; ++row) {
    for (int column = 0; column < 320; ++column) {
      // |t d - c| = r with d = (1, -u, -v), c = (2, 0, 0): t^2 |d|^2 - 4 t + 4 - r^2 = 0.
      const double u = (column - 159.5) / view.pinhole.focal(),
                   v = (row - 119.5) / view.pinhole.focal();
      const double length2 = 1.0 + u * u + v * v;
      const double root2 = 4.0 - length2 * (4.0 - 0.25);
      if (root2 < 0.05) continue;  // not near the rim, where 1 mm sideways is far behind
      EXPECT_NEAR(depths[static_cast<std::size_t>(row * 320 + column)],
                  (2.0 - std::sqrt(root2)) / length2, 0.01);
      ++seen;
    }
  }
  EXPECT_GT(seen, 3000);
}

TEST(Picture, RoundShapesReachAsFarAsTheyShould) {
  View view;
  view.camera = {{0.0, 0.0, 5.0}, from_rpy(0.0, M_PI_2, 0.0)};  // looks down
  const BodyId cylinder = view.scene.add(body(round(Shape::Type::kCylinder, 0.3, 2.0), at(0.0)));
  EXPECT_NEAR(view.depth(160, 120), 4.0, 1e-4);
  view.scene.remove(cylinder);
  view.scene.add(body(round(Shape::Type::kCapsule, 0.3, 2.0), at(0.0)));
  EXPECT_NEAR(view.depth(160, 120), 3.7, 1e-3);
}

// Red and green above blue and white.
std::shared_ptr<const Texture> four_colors() {
  Texture texture{4, 4, {}};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const bool left = column < 2, top = row < 2;
      for (const bool lit : {left == top, !left, !top}) texture.bytes.push_back(lit ? 255 : 0);
    }
  }
  return std::make_shared<const Texture>(texture);
}

void expect_four_colors(const View& view) {
  const int full = expected_byte(1.0, 2.5);
  EXPECT_EQ(view.color(113, 73, {}, kDim), Eigen::Vector3i(full, 0, 0));
  EXPECT_EQ(view.color(206, 73, {}, kDim), Eigen::Vector3i(0, full, 0));
  EXPECT_EQ(view.color(113, 166, {}, kDim), Eigen::Vector3i(0, 0, full));
  EXPECT_EQ(view.color(206, 166, {}, kDim), Eigen::Vector3i(full, full, full));
}

TEST(Picture, ATextureIsUprightOnASideOfABox) {
  for (const double turn : {0.0, M_PI_2, M_PI, -M_PI_2}) {
    View view;
    Body crate = body(box(1.0, 1.0, 1.0), {{2.0, 0.0, 0.0}, from_rpy(0.0, 0.0, turn)});
    crate.surfaces[0].textures = {four_colors()};
    view.scene.add(crate);
    expect_four_colors(view);
  }
}

TEST(Picture, ATextureLiesOnAPlaneAsItsAxesDo) {
  Shape shape;
  shape.type = Shape::Type::kPlane;
  shape.size = {1.0, 1.0, 0.0};
  View view;
  view.camera = {{0.0, 0.0, 1.5}, from_rpy(0.0, M_PI_2, M_PI_2)};  // looks down, y is up
  Body floor = body(shape, at(0.0));
  floor.surfaces[0].textures = {four_colors()};
  view.scene.add(floor);
  expect_four_colors(view);
}

TEST(Picture, PartsOfAMeshHaveTheirOwnColorAndTexture) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices = {{0, 1, -1}, {0, -1, -1}, {0, -1, 1}, {0, 1, 1}};
  mesh->triangles = {{0, 2, 1}, {0, 3, 2}};
  auto look = std::make_shared<MeshLook>();
  look->parts = {{0, {0.25F, 0.5F, 1.0F, 1.0F}, ""}, {1, {1, 1, 1, 1}, "four.png"}};
  look->corners = {{0, 0, 1, 1, 1, 0}, {0, 0, 0, 1, 1, 1}};
  Body sheet = body(Shape{}, at(1.5));
  sheet.surfaces[0].shape.type = Shape::Type::kMesh;
  sheet.surfaces[0].shape.mesh = mesh;
  sheet.surfaces[0].look = look;
  sheet.surfaces[0].textures = {nullptr, four_colors()};
  View view;
  view.scene.add(sheet);
  EXPECT_EQ(
      view.color(200, 150, {}, kDim),
      Eigen::Vector3i(expected_byte(0.25, 2.5), expected_byte(0.5, 2.5), expected_byte(1.0, 2.5)));
  EXPECT_EQ(view.color(100, 60, {}, kDim), Eigen::Vector3i(expected_byte(1.0, 2.5), 0, 0));
}

TEST(Picture, LeftIsLeftAndUpIsUp) {
  View view;
  view.scene.add(body(box(0.1, 0.5, 0.5), at(2.0, 0.6, 0.4), {1.0F, 0.0F, 0.0F}));
  view.scene.add(body(box(0.1, 0.5, 0.5), at(2.0, -0.6, -0.4), {0.0F, 1.0F, 0.0F}));
  const Eigen::Vector3i upper_left = view.color(75, 60, {}, kDim);
  const Eigen::Vector3i lower_right = view.color(245, 180, {}, kDim);
  EXPECT_GT(upper_left.x(), 50);
  EXPECT_EQ(upper_left.y(), 0);
  EXPECT_GT(lower_right.y(), 50);
  EXPECT_EQ(lower_right.x(), 0);
  EXPECT_EQ(view.color(245, 60, {}, kDim), Eigen::Vector3i::Zero());
}

TEST(Picture, WhatMovesAndGoesIsSeenSo) {
  View view;
  Body made = body(box(1.0, 1.0, 1.0), at(3.0));
  made.moves = true;
  const BodyId moving = view.scene.add(made);
  const BodyId still = view.scene.add(body(box(1.0, 20.0, 20.0), at(6.0)));
  EXPECT_NEAR(view.depth(160, 120), 2.5, 1e-4);
  view.scene.move(moving, at(4.0));
  EXPECT_NEAR(view.depth(160, 120), 3.5, 1e-4);
  view.scene.remove(moving);
  EXPECT_NEAR(view.depth(160, 120), 5.5, 1e-4);
  view.scene.move(still, at(7.0));
  EXPECT_NEAR(view.depth(160, 120), 6.5, 1e-4);
  view.scene.remove(still);
  EXPECT_TRUE(std::isnan(view.depth(160, 120)));
}

TEST(Picture, NearerThanNearAndFartherThanFarIsNotSeen) {
  View view;
  view.scene.add(body(box(0.1, 1.0, 1.0), at(0.5)));
  view.scene.add(body(box(0.1, 1.0, 1.0), at(5.0)));
  view.pinhole.near = 1.0;
  EXPECT_NEAR(view.depth(160, 120), 4.95, 1e-4);
  view.pinhole.far = 4.0;
  EXPECT_TRUE(std::isnan(view.depth(160, 120)));
}

TEST(Picture, SizesThatAreNoMultipleOfATileAreFilled) {
  View view;
  view.pinhole.width = 33;
  view.pinhole.height = 17;
  view.scene.add(body(box(1.0, 50.0, 50.0), at(3.5)));
  const std::vector<float> depths = view.scene.depths(view.pinhole, view.camera);
  ASSERT_EQ(depths.size(), 33U * 17U);
  for (const float depth : depths) ASSERT_NEAR(depth, 3.0, 1e-4);
  EXPECT_EQ(view.scene.colors(view.pinhole, view.camera, {}, kDim).size(), 3U * 33U * 17U);
}

TEST(Picture, BackgroundIsShownAsItIs) {
  View view;
  const Ambience sky{Eigen::Vector3f::Ones(), {0.0F, 0.5F, 1.0F}};
  EXPECT_EQ(view.color(0, 0, {}, sky), Eigen::Vector3i(0, 128, 255));
}

}  // namespace
}  // namespace angen::render
