// A cache has bit for bit the hits of a cast of all rays.
#include "rays/ray_cache.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/random.h"
#include "shapes.h"

namespace angen::rays::testing {
namespace {

/// Rays of a fan, and special ones: along an axis, too short, without direction, infinite.
std::vector<Ray> fan(Rng& rng, double reach) {
  const Pose pose = random_pose(rng, 3.0);
  std::vector<Ray> rays(33);
  for (Ray& r : rays) {
    r.origin = pose.position;
    r.direction =
        (pose.rotation * Vec3(1.0, rng.uniform() - 0.5, rng.uniform() - 0.5)).normalized();
    r.min = 0.02;
    r.max = reach;
  }
  rays[30].direction = Vec3::UnitX();
  rays[31].max = 0.01;
  rays[32].direction = Vec3::Zero();
  return rays;
}

void expect_same(const std::vector<Hit>& a, const std::vector<Hit>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(std::memcmp(&a[i].range, &b[i].range, sizeof(double)), 0) << i;
    EXPECT_EQ(a[i].shape, b[i].shape) << i;
    EXPECT_EQ(a[i].normal, b[i].normal) << i;
  }
}

std::vector<ShapeId> in_reach(const Scene& scene, const RayCache& cache,
                              const std::vector<ShapeId>& movers) {
  std::vector<ShapeId> found;
  for (const ShapeId id : movers) {
    if (cache.reach().intersects(scene.bounds(id))) found.push_back(id);
  }
  return found;
}

struct Room {
  explicit Room(std::uint64_t seed) : rng(seed, hash_bytes("cache"), 0) {
    for (int i = 0; i < 20; ++i) fixed.push_back(put(Mobility::kStatic));
    for (int i = 0; i < 12; ++i) movers.push_back(put(Mobility::kMoving));
  }
  ShapeId put(Mobility mobility) {
    return add(scene, random_shape(rng), random_pose(rng, 4.0), mobility);
  }
  void expect_the_cast_of_all(const std::vector<Ray>& rays, const RayCache& cache) {
    std::vector<Hit> all;
    scene.commit();
    scene.cast(rays, all);
    std::vector<Hit> seen(rays.size());
    cache.cast(scene, in_reach(scene, cache, movers), seen.data());
    expect_same(seen, all);
  }

  Rng rng;
  Scene scene;
  std::vector<ShapeId> fixed;
  std::vector<ShapeId> movers;
};

class RandomRooms : public ::testing::TestWithParam<double> {};  // reach, m

TEST_P(RandomRooms, SeenAsByTheCastOfAllRaysWhileThingsMoveComeAndGo) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Room room(seed);
    room.scene.commit();
    const std::vector<Ray> rays = fan(room.rng, GetParam());
    RayCache cache(rays, room.scene);
    for (int turn = 0; turn < 10; ++turn) {
      for (const ShapeId id : room.movers) room.scene.move(id, random_pose(room.rng, 4.0));
      if (turn % 3 == 1) {
        room.scene.remove(room.movers.back());
        room.movers.back() = room.put(Mobility::kMoving);
      }
      if (turn % 3 == 2) {
        room.scene.remove(room.fixed.back());
        room.fixed.back() = room.put(Mobility::kStatic);
        room.scene.commit();
        cache.measure(room.scene);
      }
      room.expect_the_cast_of_all(rays, cache);
    }
  }
}
TEST_P(RandomRooms, SeenAsByTheCastOfAllRaysWhileSomeMoversAreSettled) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Room room(seed);
    room.scene.commit();
    const std::vector<Ray> rays = fan(room.rng, GetParam());
    RayCache cache(rays, room.scene);
    for (int turn = 0; turn < 6; ++turn) {
      const auto middle = room.movers.begin() + 2 * turn;
      const std::vector<ShapeId> still(room.movers.begin(), middle);
      const std::vector<ShapeId> moving(middle, room.movers.end());
      for (const ShapeId id : still) room.scene.move(id, random_pose(room.rng, 4.0));
      cache.settle(room.scene, still);
      for (const ShapeId id : moving) room.scene.move(id, random_pose(room.rng, 4.0));
      std::vector<Hit> all;
      room.scene.commit();
      room.scene.cast(rays, all);
      std::vector<Hit> seen(rays.size());
      cache.cast(room.scene, moving, seen.data());
      expect_same(seen, all);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Reach, RandomRooms,
                         ::testing::Values(6.0, std::numeric_limits<double>::infinity()));

TEST(RayCache, AMovingPlaneIsInEveryReach) {
  Room room(1);
  room.movers.push_back(add(room.scene, plane(), at(0, 0, -1), Mobility::kMoving));
  room.scene.commit();
  const std::vector<Ray> rays = fan(room.rng, 6.0);
  room.expect_the_cast_of_all(rays, RayCache(rays, room.scene));
}

TEST(RayCache, AStaticSurfaceIsMetBeforeAMoverInTheSamePlane) {
  Scene scene;
  const ShapeId mover = add(scene, box(1, 1, 1), at(2, 0, 0), Mobility::kMoving);
  const ShapeId wall = add(scene, box(1, 1, 1), at(2, 0, 0));
  scene.commit();
  const RayCache cache({ray(Vec3::Zero(), Vec3::UnitX())}, scene);
  Hit hit;
  EXPECT_FALSE(cache.cast(scene, {mover}, &hit));
  EXPECT_EQ(hit.shape, wall.index);
}

TEST(RayCache, ReachesAsFarAsItsRaysAreNotStopped) {
  Scene scene;
  add(scene, box(1, 9, 9), at(3, 0, 0));
  scene.commit();
  Ray r = ray(Vec3::Zero(), Vec3::UnitX());
  r.max = 6.0;
  EXPECT_NEAR(RayCache({r}, scene).reach().max().x(), 2.5, 1e-5);
}

TEST(RayCache, WithoutRaysReachesNothing) {
  const Scene scene;
  EXPECT_TRUE(RayCache({}, scene).reach().isEmpty());
}

}  // namespace
}  // namespace angen::rays::testing
