#include "render/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "core/mesh_look.h"
#include "core/texture.h"
#include "light/reflected_light.h"

namespace angen::render {
namespace {

Shape box(double x, double y, double z) {
  Shape shape;
  shape.type = Shape::Type::kBox;
  shape.size = {x, y, z};
  return shape;
}

Shape round(Shape::Type type, double radius, double length = 0.0) {
  Shape shape;
  shape.type = type;
  shape.radius = radius;
  shape.length = length;
  return shape;
}

Pose at(double x, double y = 0.0, double z = 0.0) { return {{x, y, z}, Quat::Identity()}; }

Body body(const Shape& shape, const Pose& pose, const Eigen::Vector3f& color = {0.5F, 0.5F, 0.5F}) {
  Body made;
  made.surfaces.push_back({shape, Pose{}, color, Eigen::Vector3f::Zero()});
  made.pose = pose;
  return made;
}

light::Lit lamp(const Vec3& position, double lumen) {
  light::Lit lit;
  lit.lamp.pose.position = position;
  lit.lamp.luminous_flux = lumen;
  lit.level = 1.0;
  return lit;
}

const Ambience kDark{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
const Ambience kDim{Eigen::Vector3f::Ones(), Eigen::Vector3f::Zero()};

/// The byte of a surface of albedo `albedo` under `lux`, by the header's formula.
int expected_byte(double albedo, double lux) {
  const double luminance = albedo * lux / M_PI;
  const double v = luminance / (luminance + 10.0);
  return static_cast<int>(
      std::lround(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055)));
}

struct View {
  PinholeCamera pinhole;
  Scene scene;
  Pose camera;

  float depth(int column, int row) const {
    return scene.depths(pinhole, camera)[static_cast<std::size_t>(row * pinhole.width + column)];
  }
  Eigen::Vector3i color(int column, int row, const std::vector<light::Lit>& lamps,
                        const Ambience& ambience = kDark) const {
    const std::vector<std::uint8_t> all = scene.colors(pinhole, camera, lamps, ambience);
    const std::size_t first = 3 * static_cast<std::size_t>(row * pinhole.width + column);
    return {all[first], all[first + 1], all[first + 2]};
  }
};

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

TEST(Picture, ALampLightsByTheInverseSquareAndTheCosine) {
  View view;
  view.camera = {{0.0, 0.0, 2.0}, from_rpy(0.0, M_PI_2, 0.0)};
  view.scene.add(body(box(50.0, 50.0, 1.0), at(0.0, 0.0, -0.5), {0.6F, 0.3F, 0.1F}));
  const Eigen::Vector3i color = view.color(200, 90, {lamp({1.0, 0.5, 1.5}, 800.0)});
  // Looking down, the picture's top is world x and its left world y.
  const double x = (119.5 - 90) / view.pinhole.focal() * 2,
               y = (159.5 - 200) / view.pinhole.focal() * 2;
  const double square = std::pow(1.0 - x, 2) + std::pow(0.5 - y, 2) + 1.5 * 1.5;
  const double lux = 800.0 / (4 * M_PI * square) * 1.5 / std::sqrt(square);
  EXPECT_NEAR(color.x(), expected_byte(0.6, lux), 1);
  EXPECT_NEAR(color.y(), expected_byte(0.3, lux), 1);
  EXPECT_NEAR(color.z(), expected_byte(0.1, lux), 1);
}

TEST(Picture, WhatSurfacesReflectIsAddedToWhatLampsGive) {
  View view;
  view.camera = {{0.0, 0.0, 2.0}, from_rpy(0.0, M_PI_2, 0.0)};
  view.scene.add(body(box(50.0, 50.0, 1.0), at(0.0, 0.0, -0.5), {0.6F, 0.3F, 0.1F}));
  Ambience ambience = kDim;
  std::vector<light::ReflectedLight::Piece> pieces;
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) {
      pieces.push_back({{0.4F * static_cast<float>(x), 0.4F * static_cast<float>(y), 0.0F},
                        Eigen::Vector3f::UnitZ(),
                        {30.0F, 20.0F, 10.0F}});
    }
  }
  ambience.reflected = std::make_shared<const light::ReflectedLight>(pieces);
  for (const auto& [column, row] : {std::pair{160, 120}, {37, 201}, {310, 5}}) {
    const Eigen::Vector3i color = view.color(column, row, {}, ambience);
    EXPECT_NEAR(color.x(), expected_byte(0.6, 32.5), 1);
    EXPECT_NEAR(color.y(), expected_byte(0.3, 22.5), 1);
    EXPECT_NEAR(color.z(), expected_byte(0.1, 12.5), 1);
  }
}

/// Pieces on the floor, each 0.2 m, that reflect 20 lx and 8 lx more for each meter along x.
std::shared_ptr<const light::ReflectedLight> rising_light() {
  std::vector<light::ReflectedLight::Piece> pieces;
  for (int x = -30; x <= 30; ++x) {
    for (int y = -30; y <= 30; ++y) {
      const Eigen::Vector3f place(0.2F * static_cast<float>(x), 0.2F * static_cast<float>(y), 0.0F);
      const Eigen::Vector3f light = Eigen::Vector3f::Constant(20.0F + 8.0F * place.x());
      pieces.push_back({place, Eigen::Vector3f::UnitZ(), light});
    }
  }
  return std::make_shared<const light::ReflectedLight>(pieces);
}

TEST(Picture, ReflectedLightIsThatOfAPlaceWithinADecimeter) {
  View view;
  view.pinhole.width = 640;
  view.pinhole.height = 480;
  view.camera = {{0.0, 0.0, 2.0}, from_rpy(0.0, M_PI_2, 0.0)};
  view.scene.add(body(box(50.0, 50.0, 1.0), at(0.0, 0.0, -0.5), {0.6F, 0.6F, 0.6F}));
  Ambience ambience = kDark;
  ambience.reflected = rising_light();
  const std::vector<std::uint8_t> all = view.scene.colors(view.pinhole, view.camera, {}, ambience);
  for (int row = 0; row < 480; row += 7) {
    const double x = 2.0 * (view.pinhole.center_y() - row) / view.pinhole.focal();
    for (int column = 0; column < 640; column += 7) {
      const int shown = all[static_cast<std::size_t>(3 * (row * 640 + column))];
      EXPECT_GE(shown, expected_byte(0.6, 20.0 + 8.0 * (x - 0.1)) - 1) << row << ' ' << column;
      EXPECT_LE(shown, expected_byte(0.6, 20.0 + 8.0 * (x + 0.1)) + 1) << row << ' ' << column;
    }
  }
}

TEST(Picture, IsTheSameOnAnyNumberOfThreads) {
  std::vector<std::uint8_t> colors;
  std::vector<float> depths;
  Ambience ambience = kDim;
  ambience.reflected = rising_light();
  for (const int threads : {1, 2, 3, 8}) {
    Scene scene(threads);
    scene.add(body(box(50.0, 50.0, 1.0), at(0.0, 0.0, -0.5)));
    for (int i = 0; i < 9; ++i) {
      Body ball = body(round(Shape::Type::kSphere, 0.3), at(0.5 * i, 0.7 * (i % 3) - 0.7, 0.3));
      ball.moves = i % 2 == 0;
      scene.add(ball);
    }
    const std::vector<light::Lit> lamps{lamp({1.0, 1.0, 2.0}, 800.0),
                                        lamp({3.0, -2.0, 1.0}, 500.0)};
    PinholeCamera pinhole;
    pinhole.height = 239;
    const Pose camera{{-1.5, 0.0, 1.5}, from_rpy(0.0, 0.5, 0.1)};
    const std::vector<float> alone = scene.depths(pinhole, camera);
    const std::vector<std::uint8_t> now = scene.colors(pinhole, camera, lamps, ambience);
    if (threads == 1) {
      colors = now;
      depths = alone;
    }
    const auto equal = [](const auto& a, const auto& b) {
      return std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
    };
    EXPECT_TRUE(equal(now, colors)) << threads;
    EXPECT_TRUE(equal(alone, depths)) << threads;
    EXPECT_TRUE(equal(scene.depths(pinhole, camera), depths)) << threads;
  }
}

TEST(Picture, ABoxThrowsAShadowWhereTheLampIsHidden) {
  View view;
  view.camera = {{0.0, 0.0, 3.0}, from_rpy(0.0, M_PI_2, 0.0)};
  view.scene.add(body(box(50.0, 50.0, 1.0), at(0.0, 0.0, -0.5)));
  // Between a lamp at (1, 0, 2) and the floor at x = -1 ... -0.6.
  view.scene.add(body(box(0.2, 1.0, 0.01), at(0.1, 0.0, 1.0)));
  const std::vector<light::Lit> lamps{lamp({1.0, 0.0, 2.0}, 800.0)};
  const auto column_of = [&](double y) {
    return static_cast<int>(std::lround(159.5 - y / 3.0 * view.pinhole.focal()));
  };
  const auto row_of = [&](double x) {
    return static_cast<int>(std::lround(119.5 - x / 3.0 * view.pinhole.focal()));
  };
  EXPECT_EQ(view.color(column_of(0.0), row_of(-0.85), lamps), Eigen::Vector3i::Zero());
  EXPECT_GT(view.color(column_of(0.0), row_of(-0.4), lamps).x(), 50);
  EXPECT_GT(view.color(column_of(1.2), row_of(-0.85), lamps).x(), 50);
}

TEST(Picture, ALampShinesThroughItsOwnShade) {
  View view;
  view.camera = {{0.0, 0.0, 2.0}, from_rpy(0.0, M_PI_2, 0.0)};
  view.scene.add(body(box(50.0, 50.0, 1.0), at(0.0, 0.0, -0.5)));
  Body shade = body(round(Shape::Type::kSphere, 0.2), at(1.0, 0.0, 1.0));
  shade.holds_lamp = true;
  view.scene.add(shade);
  EXPECT_GT(view.color(160, 120, {lamp({1.0, 0.0, 1.0}, 800.0)}).x(), 50);
  // And the shade itself is bright, seen from outside.
  view.camera = at(-1.0, 0.0, 1.0);
  EXPECT_GT(view.color(160, 120, {lamp({1.0, 0.0, 1.0}, 800.0)}).x(), 200);
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
