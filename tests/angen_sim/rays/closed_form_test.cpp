// Ranges and normals of each shape against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

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

/// A ray that meets a shape; no range of a miss, no normal where it is not checked.
struct Case {
  const char* what;
  Shape shape;
  Pose pose;
  Vec3 origin;
  Vec3 direction;
  double range;
  Vec3 normal = Vec3::Zero();
};

constexpr double kMiss = std::numeric_limits<double>::infinity();

TEST(ClosedForm, OfEachShapeAndSide) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const Shape crate = box(2, 4, 6), sphere = round(Shape::Type::kSphere, 1.0);
  const Shape cylinder = round(Shape::Type::kCylinder, 0.5, 2.0);
  const Shape capsule = round(Shape::Type::kCapsule, 0.5, 2.0);
  const Pose here, lying = at(0, 0, 0, from_rpy(M_PI / 2, 0, 0));
  const Pose eighth = at(5, 0, 0, from_rpy(0, 0, M_PI / 4));
  const Pose slope = at(0, 0, 0, from_rpy(0, M_PI / 4, 0));
  const double root = std::sqrt(2.0);
  const std::vector<Case> cases = {
      {"box from outside", crate, at(5, 0, 0), {0, 1, 2}, x, 4.0, -x},
      {"box from inside meets the far side", crate, here, {0.5, 0, 0}, x, 0.5, -x},
      {"box turned",
       box(2, 2, 2),
       eighth,
       {0, 0.25, 0},
       x,
       5 - root + 0.25,
       {-1 / root, 1 / root, 0}},
      {"beside a box", crate, at(5, 0, 0), {0, 2.001, 0}, x, kMiss},
      {"behind the ray", crate, at(5, 0, 0), {0, 0, 0}, -x, kMiss},
      {"sheet from one side", box(0, 2, 2), at(1, 0, 0), {0, 0.1, 0.2}, x, 1.0},
      {"sheet from the other", box(0, 2, 2), at(1, 0, 0), {3, 0.1, 0.2}, -x, 2.0},
      {"sphere from outside", sphere, at(5, 0, 0), {0, 0.6, 0}, x, 4.2, {-0.8, 0.6, 0}},
      {"sphere from inside", sphere, at(5, 0, 0), {5, 0.6, 0}, x, 0.8, {-0.8, -0.6, 0}},
      {"cylinder's wall", cylinder, at(3, 0, 0), {0, 0.3, 0.9}, x, 2.6, {-0.8, 0.6, 0}},
      {"above a cylinder", cylinder, at(3, 0, 0), {0, 0.3, 1.001}, x, kMiss},
      {"cylinder's end from outside", cylinder, here, {0.1, 0.1, 4}, -z, 3.0, z},
      {"cylinder's end from inside", cylinder, here, {0.1, 0.1, 0.25}, -z, 1.25, z},
      {"lying cylinder's end", cylinder, lying, {0, -3, 0.2}, y, 2.0},
      {"lying cylinder's wall", cylinder, lying, {0, 0.9, 3}, -z, 2.5},
      {"capsule's wall", capsule, here, {-3, 0.3, 0.9}, x, 2.6, {-0.8, 0.6, 0}},
      {"capsule's cap", capsule, here, {0.3, 0, 4}, -z, 2.6, {0.6, 0, 0.8}},
      {"capsule's cap from inside", capsule, here, {0, 0, 0.2}, z, 1.3},
      {"plane from above", plane(), at(0, 0, 1), {900, 0, 3}, -z, 2.0},
      {"plane from below", plane(), at(0, 0, 1), {0, 0, 0}, {3, 0, 4}, 1.25, -z},
      {"along a plane", plane(), at(0, 0, 1), {0, 0, 3}, x, kMiss},
      {"tilted plane from above", plane(), slope, {0, 0, 2}, -z, 2.0},
      {"tilted plane from aside", plane(), slope, {2, 0, 0}, -x, 2.0}};
  for (const Case& each : cases) {
    SCOPED_TRACE(each.what);
    const Hit hit = Alone(each.shape, each.pose)(each.origin, each.direction);
    ASSERT_EQ(hit.hit(), each.range != kMiss);
    if (!hit.hit()) continue;
    EXPECT_NEAR(hit.range, each.range, kExact);
    if (!each.normal.isZero()) expect_normal(hit, each.normal);
  }
}

TEST(ClosedForm, SmallSphereFarAwayKeepsItsDigits) {
  const Alone sphere(round(Shape::Type::kSphere, 0.01), at(500, 0, 0));
  EXPECT_NEAR(sphere(Vec3(0, 0.006, 0), Vec3::UnitX()).range, 500 - 0.008, 1e-9);
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
