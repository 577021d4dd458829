// The cost by which the light between surfaces is divided into ticks.
#include "light/field.h"

#include <gtest/gtest.h>

#include <memory>

#include "core/random.h"
#include "rooms.h"

namespace angen::light::testing {
namespace {

/// Long triangles through the middle, each of which crosses most others.
Shape hedgehog(int spikes) {
  auto mesh = std::make_shared<TriangleMesh>();
  Rng rng(1, 0, 0);
  const auto draw = [&](double spread) {
    const double x = rng.gaussian(), y = rng.gaussian(), z = rng.gaussian();
    return Eigen::Vector3f((spread * Vec3(x, y, z)).cast<float>());
  };
  for (std::uint32_t i = 0; i < 3U * static_cast<unsigned>(spikes); i += 3) {
    const Eigen::Vector3f tip = draw(0.5), aside = draw(0.02);
    mesh->vertices.insert(mesh->vertices.end(), {tip, aside - tip, -aside - tip});
    mesh->triangles.push_back({i, i + 1, i + 2});
  }
  Shape shape;
  shape.type = Shape::Type::kMesh;
  shape.mesh = mesh;
  return shape;
}

/// Surfaces around so many hedgehogs that a million rays follow.
std::size_t followed(int hedgehogs) {
  rays::Scene scene;
  add_room(scene, Vec3(-3, -3, -3), Vec3(3, 3, 3), gray(0.7F));
  const Shape shape = hedgehog(500);
  for (int i = 0; i < hedgehogs; ++i) {
    scene.add(shape, {Vec3(0.02 * i, 0, 0), Quat::Identity()}, rays::Mobility::kStatic, gray(0.7F));
  }
  scene.commit();
  Field field(scene);
  Unfinished work(point_lamp(Vec3(0, 0, 2.5), 800.0));
  std::int64_t rays = 1'000'000;
  field.advance(work, rays);
  return work.followed;
}

TEST(Field, RaysThroughAPileOfMeshesCostMore) {
  EXPECT_GT(followed(0), 1000U);
  EXPECT_LT(followed(8), 100U);  // a ray tests hundreds of triangles
}

}  // namespace
}  // namespace angen::light::testing
