// Standing shapes apart from their scene: in a scene of their own, and those around a place.
#include "rays/nearby.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "shapes.h"

namespace angen::rays::testing {
namespace {

constexpr Mobilities kAtRest = kAll & ~only(Mobility::kMoving);

/// Boxes, spheres and cylinders of all mobilities that overlap, and a floor.
struct Heap {
  Heap() {
    for (int i = 0; i < 300; ++i) {
      const Vec3 size = 0.1 * Vec3::Ones() + 0.4 * any();
      Shape shape = box(size.x(), size.y(), size.z());
      if (i % 3 != 0) shape.type = i % 3 == 1 ? Shape::Type::kSphere : Shape::Type::kCylinder;
      shape.radius = size.x() / 2;
      shape.length = size.z();
      const Pose pose{3.0 * any(), from_rpy(any().x(), any().y(), any().z())};
      ids.push_back(add(scene, shape, pose, static_cast<Mobility>(i % 4 % 3)));
    }
    Shape floor;
    floor.type = Shape::Type::kPlane;
    add(scene, floor);
    scene.commit();
  }
  Vec3 any() { return {rng.uniform(), rng.uniform(), rng.uniform()}; }

  Rng rng{1, hash_bytes("heap"), 0};
  Scene scene;
  std::vector<ShapeId> ids;
};

TEST(Nearby, AnswersAsTheScene) {
  Heap heap;
  int blocked = 0, covered = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 low = 3.0 * heap.any() - Vec3::Constant(0.1);
    const Nearby near = heap.scene.near({low, low + Vec3::Constant(0.3)});
    for (int k = 0; k < 10; ++k) {
      const Vec3 from = low + 0.3 * heap.any(), to = low + 0.3 * heap.any();
      const Mobilities among = k % 2 == 0 ? kAtRest : only(Mobility::kAnchored);
      EXPECT_EQ(near.blocked(from, to, 1e-4, among), heap.scene.blocked(from, to, 1e-4, among));
      const std::uint32_t except = heap.ids[static_cast<std::size_t>(i)].index;
      EXPECT_EQ(near.covered(from, except), heap.scene.covered(from, except));
      blocked += near.blocked(from, to, 1e-4, among) ? 1 : 0;
      covered += near.covered(from, except) ? 1 : 0;
    }
  }
  EXPECT_GT(blocked, 100);
  EXPECT_GT(covered, 100);
}

TEST(StandingScene, IsThatOfItsTimeWhileTheOtherChanges) {
  Heap heap;
  std::vector<Ray> rays(500);
  for (Ray& ray : rays) {
    ray.origin = 3.0 * heap.any();
    ray.direction = (heap.any() - heap.any()).normalized();
  }
  for (const Mobilities among : {kAtRest, only(Mobility::kStatic), only(Mobility::kAnchored)}) {
    std::vector<Hit> before(rays.size()), after(rays.size());
    heap.scene.cast(rays.data(), before.data(), rays.size(), among);
    const auto copy = heap.scene.standing_scene();
    for (const ShapeId id : heap.ids) {
      EXPECT_EQ(copy->mobility(id.index), heap.scene.mobility(id.index));
    }
    EXPECT_EQ(copy->static_bounds().max(), heap.scene.static_bounds().max());
    for (const ShapeId id : heap.ids) {
      heap.scene.move(
          id, {heap.scene.placement(id.index).pose.position + Vec3(0.1, 0, 0), Quat::Identity()});
    }
    heap.scene.commit();
    copy->cast(rays.data(), after.data(), rays.size(), among);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(before[i].shape, after[i].shape);
      EXPECT_EQ(before[i].range, after[i].range);
    }
  }
}

}  // namespace
}  // namespace angen::rays::testing
