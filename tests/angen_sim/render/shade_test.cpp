#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "light/reflected_light.h"
#include "scene_view.h"

namespace angen::render {
namespace {

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

/// A floor from 2 m above it.
struct FloorView : View {
  explicit FloorView(double yaw) {
    pinhole.width = 640;
    pinhole.height = 480;
    camera = {{0.0, 0.0, 2.0}, from_rpy(0.0, M_PI_2, yaw)};
    scene.add(body(box(50.0, 50.0, 1.0), at(0.0, 0.0, -0.5), {0.6F, 0.6F, 0.6F}));
  }
  std::vector<std::uint8_t> lit_by(std::shared_ptr<const light::ReflectedLight> light) const {
    Ambience ambience = kDark;
    ambience.reflected = std::move(light);
    return scene.colors(pinhole, camera, {}, ambience);
  }
};

TEST(Picture, ReflectedLightIsThatOfAPlaceWithinADecimeter) {
  FloorView view(0.0);
  const std::vector<std::uint8_t> all = view.lit_by(rising_light());
  for (int row = 0; row < 480; row += 7) {
    const double x = 2.0 * (view.pinhole.center_y() - row) / view.pinhole.focal();
    for (int column = 0; column < 640; column += 7) {
      const int shown = all[static_cast<std::size_t>(3 * (row * 640 + column))];
      EXPECT_GE(shown, expected_byte(0.6, 20.0 + 8.0 * (x - 0.1)) - 1) << row << ' ' << column;
      EXPECT_LE(shown, expected_byte(0.6, 20.0 + 8.0 * (x + 0.1)) + 1) << row << ' ' << column;
    }
  }
}

TEST(Picture, ReflectedLightOnAFlatPieceHasNoSteps) {
  FloorView view(M_PI_2);  // x to the right
  const std::vector<std::uint8_t> all = view.lit_by(rising_light());
  for (int row = 0; row < 480; ++row) {
    for (int column = 0; column < 640; ++column) {
      const double x = 2.0 * (column - view.pinhole.center_x()) / view.pinhole.focal();
      const int shown = all[static_cast<std::size_t>(3 * (row * 640 + column))];
      ASSERT_NEAR(shown, expected_byte(0.6, 20.0 + 8.0 * x), 1) << row << ' ' << column;
    }
  }
}

/// Two plates with a gap of 2 cm between them, 3 cm over a floor. The plates reflect 30 lx, the
/// floor nothing.
TEST(Picture, ReflectedLightInAGapIsNotThatBesideIt) {
  FloorView view(M_PI_2);  // x to the right
  for (const double side : {-1.0, 1.0}) {
    view.scene.add(body(box(3.0, 6.0, 0.01), at(1.51 * side, 0.0, 0.025), {0.6F, 0.6F, 0.6F}));
  }
  std::vector<light::ReflectedLight::Piece> pieces;
  for (int x = -14; x <= 14; ++x) {
    for (int y = -14; y <= 14; ++y) {
      const Eigen::Vector3f place(0.2F * static_cast<float>(x), 0.2F * static_cast<float>(y), 0.0F);
      pieces.push_back({place, Eigen::Vector3f::UnitZ(), Eigen::Vector3f::Zero()});
      const Eigen::Vector3f over = place + Eigen::Vector3f(0.1F, 0.0F, 0.03F);
      pieces.push_back({over, Eigen::Vector3f::UnitZ(), Eigen::Vector3f::Constant(30.0F)});
    }
  }
  const auto all = view.lit_by(std::make_shared<const light::ReflectedLight>(pieces));
  for (int row = 0; row < 480; ++row) {
    for (int column = 0; column < 640; ++column) {
      const double x = 1.97 * (column - view.pinhole.center_x()) / view.pinhole.focal();
      const int shown = all[static_cast<std::size_t>(3 * (row * 640 + column))];
      if (std::abs(x) > 0.01) {
        ASSERT_NEAR(shown, expected_byte(0.6, 30.0), 2) << row << ' ' << column;
      } else {
        ASSERT_LT(shown, expected_byte(0.6, 5.0)) << row << ' ' << column;
      }
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

// A camera at rest shows its last image again, unless anything that it shows has changed.
TEST(Picture, IsThatOfTheSceneLampsAndLightNow) {
  const auto build = [](Scene& scene) {
    scene.add(body(box(6.0, 6.0, 1.0), at(0.0, 0.0, -0.5)));
    Body ball = body(round(Shape::Type::kSphere, 0.3), at(1.0, 0.0, 0.3));
    ball.moves = true;
    return scene.add(ball);
  };
  PinholeCamera pinhole;
  Pose camera{{-1.5, 0.0, 1.5}, from_rpy(0.0, 0.5, 0.1)};
  std::vector<light::Lit> lamps{lamp({1.0, 1.0, 2.0}, 800.0)};
  Ambience ambience = kDim;
  Scene scene;
  const BodyId ball = build(scene);
  Pose place = at(1.0, 0.0, 0.3);
  using Change = std::function<void()>;
  light::Lamp& changed = lamps[0].lamp;
  std::vector<std::uint8_t> before;
  const std::vector<Change> changes{
      [] {},
      [&] { lamps[0].level = 0.5; },
      [&] { changed.pose.position.x() = 0.5; },
      [&] { changed.luminous_flux = 400.0; },
      [&] {
        changed.color = {1.0F, 0.5F, 0.2F};
      },
      [&] { changed.radius = 1.9; },
      [&] { changed.cast_shadows = false; },
      [&] {
        changed.type = light::Lamp::Type::kRectangle;
        changed.width = changed.height = 1.0;
      },
      [&] {
        changed.direction = {0.0, 0.6, -0.8};
      },
      [&] {
        lamps.push_back(lamp({0.0, -1.0, 1.0}, 300.0));
      },
      [&] {
        ambience.ambient = {0.5F, 0.5F, 0.5F};
      },
      [&] {
        ambience.background = {0.1F, 0.5F, 0.5F};
      },
      [&] { ambience.reflected = rising_light(); },
      [&] { camera.position.z() = 1.4; },
      [&] { pinhole.horizontal_angle = 1.3; },
      [&] { place = at(1.0, 0.5, 0.3); },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    changes[i]();
    scene.move(ball, place);
    Scene fresh;
    fresh.move(build(fresh), place);
    const std::vector<std::uint8_t> now = scene.colors(pinhole, camera, lamps, ambience);
    EXPECT_EQ(now, fresh.colors(pinhole, camera, lamps, ambience)) << i;
    EXPECT_NE(now, before) << i;
    EXPECT_EQ(now, scene.colors(pinhole, camera, lamps, ambience)) << i;
    before = now;
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

// Whether the faces in the way are few or too many to be listed.
TEST(Picture, ALampInThePlaneOfTheCeilingLightsTheFloor) {
  View view;
  view.camera = {{0.0, 0.0, 1.5}, from_rpy(0.0, M_PI_2, 0.0)};
  view.scene.add(body(box(9.0, 9.0, 1.0), at(0.0, 0.0, -0.5), {0.6F, 0.6F, 0.6F}));
  view.scene.add(body(box(9.0, 9.0, 0.1), at(0.0, 0.0, 2.55)));
  const std::vector<light::Lit> lamps{lamp({1.0, 0.0, 2.5}, 4.0 * M_PI * 100.0)};
  const int expected = expected_byte(0.6, 100.0 * 2.5 / std::pow(1.0 + 2.5 * 2.5, 1.5));
  EXPECT_NEAR(view.color(160, 120, lamps)[0], expected, 1);
  for (int i = 0; i < 30; ++i) {
    view.scene.add(body(box(1e-3, 1e-3, 1e-3), at(0.5, 0.01 * (i - 14.7), 1.25)));
  }
  EXPECT_NEAR(view.color(160, 120, lamps)[0], expected, 1);
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

}  // namespace
}  // namespace angen::render
