// Ranges and normals of each shape against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "shapes.h"

namespace angen::rays::testing {
namespace {

constexpr double kExact = 1e-12;  // m

/// A scene of one shape.
struct Alone {
  explicit Alone(const Shape& shape, const Pose& pose = {}, Mobility mobility = Mobility::kStatic) {
    add(scene, shape, pose, mobility);
    scene.commit();
  }
  Hit operator()(const Vec3& origin, const Vec3& direction) const {
    return cast_one(scene, origin, direction);
  }
  Scene scene;
};

void expect_normal(const Hit& hit, const Vec3& normal) {
  EXPECT_NEAR((hit.normal.cast<double>() - normal).norm(), 0.0, 1e-6);
}

TEST(ClosedForm, BoxFromOutside) {
  const Alone box_alone(box(2, 4, 6), at(5, 0, 0));
  const Hit hit = box_alone(Vec3(0, 1, 2), Vec3::UnitX());
  EXPECT_NEAR(hit.range, 4.0, kExact);
  expect_normal(hit, -Vec3::UnitX());
}

TEST(ClosedForm, BoxFromInsideMeetsFarSide) {
  const Alone box_alone(box(2, 4, 6));
  const Hit hit = box_alone(Vec3(0.5, 0, 0), Vec3::UnitX());
  EXPECT_NEAR(hit.range, 0.5, kExact);
  expect_normal(hit, -Vec3::UnitX());
}

TEST(ClosedForm, BoxTurnedByAnEighth) {
  const Alone turned(box(2, 2, 2), at(5, 0, 0, from_rpy(0, 0, M_PI / 4)));
  const Hit hit = turned(Vec3(0, 0.25, 0), Vec3::UnitX());
  EXPECT_NEAR(hit.range, 5 - std::sqrt(2.0) + 0.25, kExact);
  expect_normal(hit, Vec3(-1, 1, 0).normalized());
}

TEST(ClosedForm, BoxIsMissedBesideIt) {
  const Alone box_alone(box(2, 4, 6), at(5, 0, 0));
  EXPECT_FALSE(box_alone(Vec3(0, 2.001, 0), Vec3::UnitX()).hit());
  EXPECT_FALSE(box_alone(Vec3(0, 0, 0), -Vec3::UnitX()).hit());
}

TEST(ClosedForm, BoxWithoutThicknessIsMetFromBothSides) {
  const Alone sheet(box(0, 2, 2), at(1, 0, 0));
  EXPECT_NEAR(sheet(Vec3(0, 0.1, 0.2), Vec3::UnitX()).range, 1.0, kExact);
  EXPECT_NEAR(sheet(Vec3(3, 0.1, 0.2), -Vec3::UnitX()).range, 2.0, kExact);
}

TEST(ClosedForm, SphereFromOutsideAndInside) {
  const Alone sphere(round(Shape::Type::kSphere, 1.0), at(5, 0, 0));
  const Hit outside = sphere(Vec3(0, 0.6, 0), Vec3::UnitX());
  EXPECT_NEAR(outside.range, 5 - 0.8, kExact);
  expect_normal(outside, Vec3(-0.8, 0.6, 0));
  const Hit inside = sphere(Vec3(5, 0.6, 0), Vec3::UnitX());
  EXPECT_NEAR(inside.range, 0.8, kExact);
  expect_normal(inside, Vec3(-0.8, -0.6, 0));
}

TEST(ClosedForm, SmallSphereFarAwayKeepsItsDigits) {
  const Alone sphere(round(Shape::Type::kSphere, 0.01), at(500, 0, 0));
  EXPECT_NEAR(sphere(Vec3(0, 0.006, 0), Vec3::UnitX()).range, 500 - 0.008, 1e-9);
}

TEST(ClosedForm, CylinderWall) {
  const Alone cylinder(round(Shape::Type::kCylinder, 0.5, 2.0), at(3, 0, 0));
  const Hit hit = cylinder(Vec3(0, 0.3, 0.9), Vec3::UnitX());
  EXPECT_NEAR(hit.range, 3 - 0.4, kExact);
  expect_normal(hit, Vec3(-0.8, 0.6, 0));
  EXPECT_FALSE(cylinder(Vec3(0, 0.3, 1.001), Vec3::UnitX()).hit());
}

TEST(ClosedForm, CylinderEnds) {
  const Alone cylinder(round(Shape::Type::kCylinder, 0.5, 2.0));
  const Hit outside = cylinder(Vec3(0.1, 0.1, 4), -Vec3::UnitZ());
  EXPECT_NEAR(outside.range, 3.0, kExact);
  expect_normal(outside, Vec3::UnitZ());
  const Hit inside = cylinder(Vec3(0.1, 0.1, 0.25), -Vec3::UnitZ());
  EXPECT_NEAR(inside.range, 1.25, kExact);
  expect_normal(inside, Vec3::UnitZ());
}

TEST(ClosedForm, CylinderLyingDown) {
  const Alone cylinder(round(Shape::Type::kCylinder, 0.5, 2.0),
                       at(0, 0, 0, from_rpy(M_PI / 2, 0, 0)));
  EXPECT_NEAR(cylinder(Vec3(0, -3, 0.2), Vec3::UnitY()).range, 2.0, kExact);
  EXPECT_NEAR(cylinder(Vec3(0, 0.9, 3), -Vec3::UnitZ()).range, 2.5, kExact);
}

TEST(ClosedForm, CapsuleWallAndCap) {
  const Alone capsule(round(Shape::Type::kCapsule, 0.5, 2.0));
  const Hit wall = capsule(Vec3(-3, 0.3, 0.9), Vec3::UnitX());
  EXPECT_NEAR(wall.range, 3 - 0.4, kExact);
  expect_normal(wall, Vec3(-0.8, 0.6, 0));
  const Hit cap = capsule(Vec3(0.3, 0, 4), -Vec3::UnitZ());
  EXPECT_NEAR(cap.range, 4 - 1.4, kExact);
  expect_normal(cap, Vec3(0.6, 0, 0.8));
  EXPECT_NEAR(capsule(Vec3(0, 0, 0.2), Vec3::UnitZ()).range, 1.3, kExact);
}

TEST(ClosedForm, PlaneFromBothSidesAndTilted) {
  const Alone level(plane(), at(0, 0, 1));
  EXPECT_NEAR(level(Vec3(900, 0, 3), -Vec3::UnitZ()).range, 2.0, kExact);
  const Hit below = level(Vec3(0, 0, 0), Vec3(3, 0, 4));
  EXPECT_NEAR(below.range, 1.25, kExact);
  expect_normal(below, -Vec3::UnitZ());
  EXPECT_FALSE(level(Vec3(0, 0, 3), Vec3::UnitX()).hit());
  const Alone tilted(plane(), at(0, 0, 0, from_rpy(0, M_PI / 4, 0)));
  EXPECT_NEAR(tilted(Vec3(0, 0, 2), -Vec3::UnitZ()).range, 2.0, kExact);
  EXPECT_NEAR(tilted(Vec3(2, 0, 0), -Vec3::UnitX()).range, 2.0, kExact);
}

TEST(ClosedForm, MeshFromOutsideAndInside) {
  for (const Mobility mobility : {Mobility::kStatic, Mobility::kMoving}) {
    const Alone mesh(octahedron(1.0F), at(5, 0, 0, from_rpy(0, 0, M_PI / 2)), mobility);
    const Hit outside = mesh(Vec3(0, 0.25, 0.125), Vec3::UnitX());
    EXPECT_NEAR(outside.range, 5 - 0.625, kExact);
    expect_normal(outside, Vec3(-1, 1, 1).normalized());
    const Hit inside = mesh(Vec3(5, 0.25, 0.125), Vec3::UnitX());
    EXPECT_NEAR(inside.range, 0.625, kExact);
    expect_normal(inside, Vec3(-1, -1, -1).normalized());
  }
}

TEST(ClosedForm, NoRaySlipsBetweenTriangles) {
  // Rays at the octahedron's edges, in the planes that two triangles share.
  const Alone mesh(octahedron(1.0F), at(0, 0, 0, from_rpy(0.3, 0.2, 0.1)));
  const Quat turn = from_rpy(0.3, 0.2, 0.1);
  for (int i = 0; i < 1000; ++i) {
    const double a = 2 * M_PI * i / 1000;
    const Vec3 from = turn * Vec3(3 * std::cos(a), 3 * std::sin(a), 0);
    ASSERT_TRUE(mesh(from, -from).hit()) << i;
  }
}

/// 64 x 64 squares of two triangles over 4 x 4 m, tilted: z = x / 2 - y / 4, exact in floats.
Shape tilted_grid() {
  constexpr std::uint32_t kSide = 64;
  auto mesh = std::make_shared<TriangleMesh>();
  for (std::uint32_t i = 0; i <= kSide; ++i) {
    for (std::uint32_t j = 0; j <= kSide; ++j) {
      const float x = 4.0F * static_cast<float>(i) / kSide - 2;
      const float y = 4.0F * static_cast<float>(j) / kSide - 2;
      mesh->vertices.push_back({x, y, x / 2 - y / 4});
      if (i == kSide || j == kSide) continue;
      const std::uint32_t a = i * (kSide + 1) + j, b = a + kSide + 1;
      mesh->triangles.push_back({a, b, b + 1});
      mesh->triangles.push_back({a, b + 1, a + 1});
    }
  }
  Shape shape;
  shape.type = Shape::Type::kMesh;
  shape.mesh = mesh;
  return shape;
}

TEST(ClosedForm, GridOfTrianglesIsOneSurface) {
  const Alone grid(tilted_grid(), at(10, 0, 0));
  // Straight down through corners, edges and diagonals (1/32 m apart), then through faces.
  for (int i = -63; i < 64; ++i) {
    for (int j = -63; j < 64; ++j) {
      const double x = i / 32.0, y = j / 32.0;
      ASSERT_EQ(grid(Vec3(10 + x, y, 4), -Vec3::UnitZ()).range, 4 - (x / 2 - y / 4)) << x << y;
      const double u = x + 0.011, v = y + 0.004;
      ASSERT_NEAR(grid(Vec3(10 + u, v, 4), -Vec3::UnitZ()).range, 4 - (u / 2 - v / 4), kExact);
    }
  }
}

TEST(ClosedForm, OneMeshInTwoPlaces) {
  Scene scene;
  const Shape shape = octahedron(1.0F);
  const ShapeId near = add(scene, shape, at(5, 0, 0));
  add(scene, shape, at(9, 0, 0), Mobility::kMoving);
  scene.commit();
  EXPECT_NEAR(cast_one(scene, Vec3(0, 0.25, 0.125), Vec3::UnitX()).range, 4.375, kExact);
  scene.remove(near);
  scene.commit();
  EXPECT_NEAR(cast_one(scene, Vec3(0, 0.25, 0.125), Vec3::UnitX()).range, 8.375, kExact);
}

TEST(ClosedForm, MinAndMaxAreInclusive) {
  const Alone box_alone(box(2, 2, 2), at(5, 0, 0));
  Ray ray;
  const auto range = [&](double min, double max) {
    ray.min = min;
    ray.max = max;
    return cast_one(box_alone.scene, ray).range;
  };
  EXPECT_EQ(range(4, 4), 4.0);
  EXPECT_EQ(range(0, 3.9999999), std::numeric_limits<double>::infinity());
  EXPECT_EQ(range(4.0000001, 9), 6.0);
  EXPECT_EQ(range(6.0000001, 9), std::numeric_limits<double>::infinity());
  EXPECT_EQ(range(-1, 9), 4.0);
}

TEST(ClosedForm, BlockedSeesBetweenTheEndsOnly) {
  const Alone box_alone(box(2, 2, 2), at(5, 0, 0));
  EXPECT_TRUE(box_alone.scene.blocked(Vec3(0, 0, 0), Vec3(10, 0, 0)));
  EXPECT_FALSE(box_alone.scene.blocked(Vec3(0, 0, 0), Vec3(4, 0, 0)));
  EXPECT_FALSE(box_alone.scene.blocked(Vec3(6, 0, 0), Vec3(9, 0, 0)));
  EXPECT_FALSE(box_alone.scene.blocked(Vec3(0, 1.1, 0), Vec3(10, 1.1, 0)));
  const Alone floor(plane());
  EXPECT_TRUE(floor.scene.blocked(Vec3(0, 0, 1), Vec3(5, 0, -1)));
  EXPECT_FALSE(floor.scene.blocked(Vec3(0, 0, 1), Vec3(5, 0, 1)));
}

}  // namespace
}  // namespace angen::rays::testing
