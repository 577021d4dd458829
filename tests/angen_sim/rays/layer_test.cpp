// A layer's hierarchy is rebuilt by the first query that needs it, not by commit().
#include <gtest/gtest.h>

#include <thread>

#include "core/random.h"
#include "shapes.h"

namespace angen::rays::testing {
namespace {

constexpr Mobilities kStanding = only(Mobility::kStatic) | only(Mobility::kAnchored);

struct Known {
  ShapeId id;
  Shape shape;
  Pose pose;
  Mobility mobility;
};

Mobility random_mobility(Rng& rng) { return static_cast<Mobility>(rng.next() % 3); }

/// Makes one random change to a scene.
void change(Scene& scene, std::vector<Known>& live, Rng& rng) {
  Known& one = live[rng.next() % live.size()];
  const std::uint64_t what = rng.next() % 6;
  if (what < 3) {
    scene.move(one.id, one.pose = random_pose(rng, 4.0));
  } else if (what == 3 && one.mobility != Mobility::kStatic) {
    const bool anchored = one.mobility == Mobility::kMoving;
    one.mobility = anchored ? Mobility::kAnchored : Mobility::kMoving;
    scene.set_anchored(one.id, anchored);
  } else if (what == 4) {
    scene.remove(one.id);
    std::swap(one, live.back());
    live.pop_back();
  } else {
    const Known added{{}, random_shape(rng), random_pose(rng, 4.0), random_mobility(rng)};
    live.push_back(added);
    live.back().id = add(scene, added.shape, added.pose, added.mobility);
  }
}

TEST(Layer, QueriesOfAnyMobilitiesBetweenChangesMissNone) {
  Rng rng(11, 1, 0);
  Scene scene;
  std::vector<Known> live;
  for (int i = 0; i < 40; ++i) {
    live.push_back({{}, random_shape(rng), random_pose(rng, 4.0), random_mobility(rng)});
    live.back().id = add(scene, live.back().shape, live.back().pose, live.back().mobility);
  }
  const Mobilities asked[] = {kStanding, kAll, only(Mobility::kStatic), only(Mobility::kMoving)};
  int hits = 0;
  for (int round = 0; round < 400; ++round) {
    change(scene, live, rng);
    scene.commit();
    const Mobilities among = asked[rng.next() % 4];
    Scene fresh;
    for (const Known& one : live) add(fresh, one.shape, one.pose, one.mobility);
    fresh.commit();
    for (int i = 0; i < 20; ++i) {
      const Ray ray{random_point(rng, 5.0), random_point(rng, 1.0).normalized()};
      Hit expected, got;
      fresh.cast(&ray, &expected, 1, among);
      scene.cast(&ray, &got, 1, among);
      ASSERT_EQ(got.range, expected.range) << "after " << round << " changes";
      const Vec3 end = ray.origin + 3.0 * ray.direction;
      ASSERT_EQ(scene.blocked(ray.origin, end, 1e-4, among),
                fresh.blocked(ray.origin, end, 1e-4, among));
      ASSERT_EQ(scene.covered(ray.origin, UINT32_MAX), fresh.covered(ray.origin, UINT32_MAX));
      hits += got.hit() ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 400);
}

TEST(Layer, ARayFromACrowdCostsMore) {
  Scene scene;
  for (int i = 0; i < 3; ++i) add(scene, octahedron(1.0F));
  add(scene, box(20, 20, 20));
  scene.commit();
  EXPECT_EQ(scene.price(Vec3(0.1, 0, 0)), 1);
  for (int i = 0; i < 20; ++i) add(scene, octahedron(1.0F), {}, Mobility::kMoving);
  scene.commit();
  EXPECT_EQ(scene.price(Vec3(0.1, 0, 0)), 1);
  for (int i = 0; i < 10; ++i) add(scene, octahedron(1.0F));
  for (int i = 0; i < 10; ++i) add(scene, octahedron(1.0F), {}, Mobility::kAnchored);
  scene.commit();
  EXPECT_GT(scene.price(Vec3(0.1, 0, 0)), 50);
  EXPECT_EQ(scene.price(Vec3(1.1, 0, 0)), 1);
}

TEST(Layer, SeveralThreadsMayBeTheFirstToAsk) {
  Scene scene;
  const ShapeId id = add(scene, box(1, 1, 1), at(2, 0, 0), Mobility::kMoving);
  for (int i = 0; i < 50; ++i) {
    scene.move(id, at(2 + i, 0, 0));
    scene.commit();
    std::vector<double> ranges(4);
    std::vector<std::thread> threads;
    for (double& range : ranges) {
      threads.emplace_back([&] { range = cast_one(scene, Vec3(0, 0, 0), Vec3::UnitX()).range; });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(ranges, std::vector<double>(4, 1.5 + i));
  }
}

}  // namespace
}  // namespace angen::rays::testing
