#include "render/rasterizer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/random.h"
#include "core/texture.h"
#include "scene_view.h"

namespace angen::render {
namespace {

constexpr float kDepthError = 1e-4F;  // relative
constexpr int kColorError = 2;
constexpr int kOther = 8;  // of some 70,000 pixels, at edges

Pose turned(Rng& rng) {
  return {{0.4 + 4.0 * rng.uniform(), 5.0 * rng.uniform() - 2.5, 4.0 * rng.uniform() - 2.0},
          from_rpy(6.0 * rng.uniform(), 6.0 * rng.uniform(), 6.0 * rng.uniform())};
}

std::shared_ptr<const Texture> ramp() {
  Texture texture{16, 16, {}};
  for (int i = 0; i < 3 * 16 * 16; ++i) texture.bytes.push_back(static_cast<std::uint8_t>(i / 3));
  return std::make_shared<const Texture>(texture);
}

/// Many-sided and plain things that move or not, in front of the sky or in a room.
struct Clutter : View {
  explicit Clutter(std::int64_t number) {
    Rng rng(1, hash_bytes("clutter"), number);
    if (number % 2 == 0) scene.add(body(box(12.0, 7.0, 7.0), at(0.0, 0.03, 0.07)));
    if (number % 3 == 0) scene.add(body(box(0.2, 0.3, 0.2), at(0.05)));  // the camera's housing
    for (int i = 0; i < 40; ++i) {
      const Vec3 size = 0.02 * Vec3::Ones() + 0.8 * Vec3(rng.uniform(), rng.uniform(), 0.02);
      const Shape shape =
          i % 7 == 0 ? round(Shape::Type::kSphere, 0.2) : box(size.x(), size.y(), size.z());
      Body thing = body(shape, turned(rng), (0.9 * size).cast<float>());
      if (i % 5 == 0) thing.surfaces[0].textures = {ramp()};
      thing.moves = i % 2 == 0;
      thing.holds_lamp = i % 11 == 0;
      scene.add(thing);
    }
    pinhole.width -= static_cast<int>(number);  // no multiple of a tile
    pinhole.horizontal_angle = number % 4 == 0 ? 3.0 : number % 4 == 1 ? 0.1 : 1.047;
    pinhole.near = number % 5 == 0 ? 1e-3 : 0.1;
    pinhole.far = number % 5 == 1 ? 2.0 : 1e4;
    for (int i = 0; i < 3; ++i) lamps.push_back(lamp(turned(rng).position, 800.0));
  }

  std::vector<light::Lit> lamps;
};

/// The pixel at which a point 2 m ahead is seen.
std::size_t pixel_of(const PinholeCamera& lens, double left, double up) {
  const double column = lens.center_x() - lens.focal() * left / 2.0;
  const double row = lens.center_y() - lens.focal() * up / 2.0;
  return static_cast<std::size_t>(std::lround(row)) * static_cast<std::size_t>(lens.width) +
         static_cast<std::size_t>(std::lround(column));
}

/// Two triangles of a sheet 2 m ahead, with corners to the left and up.
Body sheet(const std::array<Vec3, 4>& corners) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (const Vec3& corner : corners) mesh->vertices.push_back(corner.cast<float>());
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  Shape shape;
  shape.type = Shape::Type::kMesh;
  shape.mesh = mesh;
  return body(shape, at(2.0));
}

TEST(Rasterizer, FindsTheFacesOfARoom) {
  const Body room = body(box(8.0, 6.0, 3.0), at(0.0)), shelf = body(box(0.3, 1.0, 0.1), at(2.0));
  Instances instances;
  instances.set_fixed(std::make_unique<Patch>(
      std::vector<std::pair<const Body*, Pose>>{{&room, room.pose}, {&shelf, shelf.pose}}));
  instances.commit();
  const PinholeCamera lens;
  const Eye eye(lens, {{0.5, 0.2, 0.3}, from_rpy(0.0, 0.3, 0.4)});
  Rasterizer rasterizer(eye, instances);
  std::array<TileRays, kTilesOfASquare> tiles;
  for (int k = 0; k < kTilesOfASquare; ++k) {
    eye.begin(tiles[static_cast<std::size_t>(k)].rays);
    eye.aim(128 + kTile * every_other_bit(k), 64 + kTile * every_other_bit(k >> 1), 1,
            tiles[static_cast<std::size_t>(k)]);
  }
  std::array<bool, kTilesOfASquare> found{};
  ASSERT_TRUE(rasterizer.start(128, 64, kSquare, 10.0F));
  rasterizer.find_hits(128, 64, tiles, found);
  for (const bool each : found) EXPECT_TRUE(each);
  ASSERT_TRUE(rasterizer.start(128, 64, kSquare, 0.1F));
  rasterizer.find_hits(128, 64, tiles, found);
  for (const bool each : found) EXPECT_FALSE(each);
}

TEST(Rasterizer, SeesBothTrianglesOfADart) {
  View view;
  view.scene.add(sheet({{{0, 0, 0}, {0, 0.8, -0.5}, {0, 0, 0.8}, {0, -0.8, -0.5}}}));
  const std::vector<float> depths = view.scene.depths(view.pinhole, view.camera);
  EXPECT_NEAR(depths[pixel_of(view.pinhole, 0.4, -0.1)], 2.0, 1e-4);
  EXPECT_NEAR(depths[pixel_of(view.pinhole, -0.4, -0.1)], 2.0, 1e-4);
  EXPECT_TRUE(std::isnan(depths[pixel_of(view.pinhole, 0.0, -0.2)]));
}

TEST(Rasterizer, TrianglesOfOnePlaneKeepTheirColors) {
  Body two = sheet({{{0, 0.5, -0.5}, {0, -0.5, -0.5}, {0, -0.5, 0.5}, {0, 0.5, 0.5}}});
  auto look = std::make_shared<MeshLook>();
  look->parts = {{0, {1, 0, 0, 1}, ""}, {1, {0, 1, 0, 1}, ""}};
  two.surfaces[0].look = look;
  View view;
  view.scene.add(two);
  const auto colors = view.scene.colors(view.pinhole, view.camera, {}, kDim);
  const std::size_t right = 3 * pixel_of(view.pinhole, -0.2, -0.2);
  const std::size_t left = 3 * pixel_of(view.pinhole, 0.2, 0.2);
  EXPECT_EQ(colors[right], expected_byte(1.0, 2.5));
  EXPECT_EQ(colors[right + 1], 0);
  EXPECT_EQ(colors[left], 0);
  EXPECT_EQ(colors[left + 1], expected_byte(1.0, 2.5));
}

// With the least distortion of the lens, rays are not linear in the pixel: that image is traced.
TEST(Rasterizer, FindsWhatRaysHit) {
  for (std::int64_t number = 0; number < 24; ++number) {
    const Clutter clutter(number);
    const PinholeCamera& plain = clutter.pinhole;
    PinholeCamera bent = plain;
    bent.distortion.k1 = 1e-12;
    const auto depths = clutter.scene.depths(plain, clutter.camera);
    const auto traced = clutter.scene.depths(bent, clutter.camera);
    const auto colors = clutter.scene.colors(plain, clutter.camera, clutter.lamps, kDim);
    const auto traced_colors = clutter.scene.colors(bent, clutter.camera, clutter.lamps, kDim);
    int deeper = 0, other = 0;
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const bool same = std::isnan(traced[i])
                            ? std::isnan(depths[i])
                            : std::abs(depths[i] / traced[i] - 1.0F) < kDepthError;
      deeper += same ? 0 : 1;
      bool alike = true;
      for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
        alike = alike && std::abs(colors[k] - traced_colors[k]) <= kColorError;
      }
      other += alike ? 0 : 1;
    }
    EXPECT_LE(deeper, kOther) << number;
    EXPECT_LE(other, kOther) << number;
  }
}

}  // namespace
}  // namespace angen::render
