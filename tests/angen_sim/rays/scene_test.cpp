// Properties of a scene other than geometry: identity, change, ties, bad input.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <thread>
#include <utility>

#include "core/random.h"
#include "shapes.h"

namespace angen::rays::testing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Ray> random_rays(Rng& rng, std::size_t count) {
  std::vector<Ray> rays(count);
  for (Ray& r : rays) {
    r.origin = random_point(rng, 5.0);
    r.direction = random_point(rng, 1.0).normalized();
  }
  return rays;
}

TEST(Scene, EmptyMeetsNothing) {
  Scene scene;
  scene.commit();
  EXPECT_FALSE(cast_one(scene, Vec3(0, 0, 0), Vec3::UnitX()).hit());
  EXPECT_FALSE(scene.blocked(Vec3(0, 0, 0), Vec3(9, 9, 9)));
  EXPECT_EQ(cast_one(scene, Vec3(0, 0, 0), Vec3::UnitX()).range, kInfinity);
}

TEST(Scene, EmptyAndSenselessShapesAreNeverMet) {
  Scene scene;
  add(scene, Shape{});
  add(scene, round(Shape::Type::kSphere, -1.0));
  add(scene, box(kNan, 1, 1));
  add(scene, box(1, 1, 1), at(kNan, 0, 0));
  Shape no_mesh;
  no_mesh.type = Shape::Type::kMesh;
  add(scene, no_mesh);
  scene.commit();
  EXPECT_FALSE(cast_one(scene, Vec3(-5, 0, 0), Vec3::UnitX()).hit());
}

TEST(Scene, BadRaysMeetNothing) {
  Scene scene;
  add(scene, box(2, 2, 2));
  add(scene, plane());
  scene.commit();
  Ray bad;
  bad.direction = Vec3::Zero();
  EXPECT_FALSE(cast_one(scene, bad).hit());
  bad.direction = Vec3(kNan, 0, 0);
  EXPECT_FALSE(cast_one(scene, bad).hit());
  bad.direction = Vec3::UnitX();
  bad.origin = Vec3(0, kInfinity, 0);
  EXPECT_FALSE(cast_one(scene, bad).hit());
  bad.origin = Vec3(0, 0, 0);
  bad.max = kNan;
  EXPECT_FALSE(cast_one(scene, bad).hit());
  EXPECT_FALSE(scene.blocked(Vec3(3, 0, 0), Vec3(3, 0, 0)));
}

TEST(Scene, TellsWhereWarmShapesAre) {
  Scene scene;
  add(scene, box(1, 1, 1));
  const ShapeId body = add(scene, box(1, 1, 2), at(3, 0, 0), Mobility::kMoving);
  const ShapeId stove = add(scene, box(1, 1, 1), at(0, 5, 0));
  scene.warm(body, Warming::constant(307.0));
  scene.warm(stove, Warming::constant(350.0));
  scene.warm(add(scene, Shape{}), Warming::constant(300.0));  // nowhere
  scene.commit();
  ASSERT_EQ(scene.warm_shapes().size(), 2U);
  scene.move(body, at(4, 0, 0));
  scene.commit();
  EXPECT_EQ(scene.warm_shapes()[0].shape, body.index);
  EXPECT_EQ(scene.warm_shapes()[0].course.limit, 307.0);
  EXPECT_TRUE(scene.warm_shapes()[0].box.isApprox({Vec3(3.5, -0.5, -1), Vec3(4.5, 0.5, 1)}));
  scene.remove(body);
  scene.commit();
  ASSERT_EQ(scene.warm_shapes().size(), 1U);
  EXPECT_EQ(scene.warm_shapes()[0].shape, stove.index);
}

TEST(Scene, MovedShapeIsMetWhereItIs) {
  Scene scene;
  for (const Mobility mobility : {Mobility::kStatic, Mobility::kMoving}) {
    const ShapeId id = add(scene, box(1, 1, 1), at(3, 0, 0), mobility);
    scene.commit();
    ASSERT_EQ(cast_one(scene, Vec3(0, 0, 0), Vec3::UnitX()).range, 2.5);
    scene.move(id, at(7, 0, 0));
    scene.commit();
    EXPECT_EQ(cast_one(scene, Vec3(0, 0, 0), Vec3::UnitX()).range, 6.5);
    scene.remove(id);
    scene.commit();
    EXPECT_FALSE(cast_one(scene, Vec3(0, 0, 0), Vec3::UnitX()).hit());
  }
}

TEST(Scene, MovedPlaneIsMetWhereItIs) {
  Scene scene;
  const ShapeId floor = add(scene, plane());
  scene.commit();
  scene.move(floor, at(0, 0, -2));
  scene.commit();
  EXPECT_EQ(cast_one(scene, Vec3(0, 0, 1), -Vec3::UnitZ()).range, 3.0);
  scene.remove(floor);
  scene.commit();
  EXPECT_FALSE(cast_one(scene, Vec3(0, 0, 1), -Vec3::UnitZ()).hit());
}

TEST(Scene, IdOfRemovedShapeNeverNamesItsSuccessor) {
  Scene scene;
  const ShapeId old = add(scene, box(1, 1, 1));
  scene.remove(old);
  const ShapeId fresh = add(scene, box(1, 1, 1));
  EXPECT_EQ(old.index, fresh.index);
  EXPECT_THROW(scene.move(old, at(1, 0, 0)), std::out_of_range);
  EXPECT_THROW(scene.remove(old), std::out_of_range);
}

TEST(Scene, TieGoesToTheLowerIndex) {
  for (const Mobility mobility : {Mobility::kStatic, Mobility::kMoving}) {
    Scene scene;
    std::vector<ShapeId> ids;
    for (int i = 0; i < 50; ++i) ids.push_back(add(scene, box(1, 1, 1), at(3, 0, 0), mobility));
    scene.commit();
    EXPECT_EQ(cast_one(scene, Vec3(0, 0, 0), Vec3::UnitX()).shape, ids[0].index);
    scene.remove(ids[0]);
    scene.commit();
    EXPECT_EQ(cast_one(scene, Vec3(0, 0, 0), Vec3::UnitX()).shape, ids[1].index);
  }
}

TEST(Scene, TieGoesToTheStaticShape) {
  Scene scene;
  add(scene, box(1, 1, 1), at(3, 0, 0), Mobility::kMoving);
  const ShapeId fixed = add(scene, box(1, 2, 2), at(3, 0, 0));
  scene.commit();
  EXPECT_EQ(cast_one(scene, Vec3(0, 0, 0), Vec3::UnitX()).shape, fixed.index);
}

TEST(Scene, RevisionCountsOnlyChanges) {
  Scene scene;
  scene.commit();
  const std::uint64_t start = scene.revision();
  const ShapeId fixed = add(scene, box(1, 1, 1));
  const ShapeId mover = add(scene, box(1, 1, 1), at(3, 0, 0), Mobility::kMoving);
  scene.commit();
  EXPECT_EQ(scene.revision(), start + 1);
  scene.move(mover, at(3, 0, 0));
  scene.commit();
  EXPECT_EQ(scene.revision(), start + 1);
  scene.move(mover, at(4, 0, 0));
  scene.commit();
  EXPECT_EQ(scene.revision(), start + 2);
  scene.remove(fixed);
  scene.commit();
  EXPECT_EQ(scene.revision(), start + 3);
}

TEST(Scene, KnowsWhereShapesCameWentAndMoved) {
  Scene scene;
  const Eigen::AlignedBox3d near{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  const Eigen::AlignedBox3d far{Vec3(9, -1, -1), Vec3(11, 1, 1)};
  std::uint64_t then = scene.moment();
  const auto moved_near_and_far = [&] {
    const auto since = std::exchange(then, scene.moment());
    return std::pair(scene.moved_since(since, near), scene.moved_since(since, far));
  };
  const ShapeId mover = add(scene, box(1, 1, 1), at(0, 0, 0), Mobility::kMoving);
  EXPECT_EQ(moved_near_and_far(), std::pair(true, false));
  scene.move(mover, at(0, 0, 0));
  EXPECT_EQ(moved_near_and_far(), std::pair(false, false));
  scene.move(mover, at(10, 0, 0));
  EXPECT_EQ(moved_near_and_far(), std::pair(true, true)) << "where it was, and where it is";
  scene.show(mover, false);
  EXPECT_EQ(moved_near_and_far(), std::pair(false, true));
  scene.move(mover, at(0, 0, 0));
  EXPECT_EQ(moved_near_and_far(), std::pair(false, false)) << "it is hidden";
  scene.show(mover, true);
  scene.remove(mover);
  EXPECT_EQ(moved_near_and_far(), std::pair(true, false));
  add(scene, plane(), at(0, 0, 50));
  EXPECT_EQ(moved_near_and_far(), std::pair(true, true)) << "a plane is everywhere";
  const ShapeId other = add(scene, box(1, 1, 1), at(50, 0, 0), Mobility::kMoving);
  then = scene.moment();
  for (int i = 0; i < 2000; ++i) scene.move(other, at(50, i + 1.0, 0));
  EXPECT_EQ(moved_near_and_far(), std::pair(true, true)) << "too long ago";
}

TEST(Scene, ReflectanceBelongsToTheShapeMet) {
  Scene scene;
  add(scene, box(1, 1, 1), at(-3, 0, 0));
  scene.add(box(1, 1, 1), at(3, 0, 0), Mobility::kStatic, Eigen::Vector3f(0.1F, 0.2F, 0.3F));
  scene.commit();
  const Hit hit = cast_one(scene, Vec3(0, 0, 0), Vec3::UnitX());
  EXPECT_EQ(scene.reflectance(hit.shape), Eigen::Vector3f(0.1F, 0.2F, 0.3F));
}

/// A scene after many changes gives the same bits as one built at once.
TEST(Scene, HistoryLeavesNoTrace) {
  Rng rng(7, 1, 0);
  Scene grown;
  std::vector<std::pair<ShapeId, std::pair<Shape, Pose>>> live;
  for (int round_index = 0; round_index < 20; ++round_index) {
    for (int i = 0; i < 8; ++i) {
      const Shape shape = random_shape(rng);
      const Pose pose = random_pose(rng, 4.0);
      live.push_back({add(grown, shape, pose, Mobility::kMoving), {shape, pose}});
    }
    for (int i = 0; i < 3; ++i) {
      const std::size_t victim = rng.next() % live.size();
      grown.remove(live[victim].first);
      live.erase(live.begin() + static_cast<std::ptrdiff_t>(victim));
    }
    for (auto& [id, what] : live) {
      if (rng.next() % 3 != 0) continue;
      what.second = random_pose(rng, 4.0);
      grown.move(id, what.second);
    }
    grown.commit();
    Scene fresh;
    for (const auto& [id, what] : live) add(fresh, what.first, what.second);
    fresh.commit();
    std::vector<Hit> expected, got;
    const std::vector<Ray> rays = random_rays(rng, 500);
    fresh.cast(rays, expected);
    grown.cast(rays, got);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(std::memcmp(&expected[i].range, &got[i].range, sizeof(double)), 0);
      ASSERT_EQ(expected[i].normal, got[i].normal);
    }
  }
}

/// Limiting a ray to a known answer's range changes no bit of it.
TEST(Scene, ClippedRaysAreBitEqual) {
  Rng rng(8, 1, 0);
  Scene scene;
  for (int i = 0; i < 600; ++i) {
    add(scene, random_shape(rng), random_pose(rng, 4.0),
        i % 4 == 0 ? Mobility::kMoving : Mobility::kStatic);
  }
  scene.commit();
  const std::vector<Ray> rays = random_rays(rng, 20000);
  std::vector<Hit> full, clipped;
  scene.cast(rays, full);
  std::vector<Ray> shorter = rays;
  for (std::size_t i = 0; i < rays.size(); ++i) shorter[i].max = full[i].range;
  scene.cast(shorter, clipped);
  int hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(full[i].range, clipped[i].range);
    ASSERT_EQ(full[i].shape, clipped[i].shape);
    hits += full[i].hit() ? 1 : 0;
  }
  EXPECT_GT(hits, 10000);
}

/// Embree's traversal against a test of every shape, one scene for each: none is missed.
TEST(Scene, SameAsTryingEveryShape) {
  Rng rng(9, 1, 0);
  Scene all;
  std::vector<std::unique_ptr<Scene>> singles;
  for (int i = 0; i < 60; ++i) {
    const Shape shape = random_shape(rng);
    // Far from the origin floats have few digits: the traversal must still miss nothing.
    Pose pose = random_pose(rng, 4.0);
    pose.position += Vec3(2000, -1500, 300);
    add(all, shape, pose, i % 2 == 0 ? Mobility::kMoving : Mobility::kStatic);
    singles.push_back(std::make_unique<Scene>());
    add(*singles.back(), shape, pose);
    singles.back()->commit();
  }
  all.commit();
  for (Ray ray : random_rays(rng, 3000)) {
    ray.origin += Vec3(2000, -1500, 300);
    double nearest = kInfinity;
    for (const auto& single : singles) nearest = std::min(nearest, cast_one(*single, ray).range);
    ASSERT_EQ(cast_one(all, ray).range, nearest);
    if (nearest == kInfinity) continue;
    const Vec3 end = ray.origin + nearest * ray.direction;
    EXPECT_FALSE(all.blocked(ray.origin, end, 1e-4));
    EXPECT_TRUE(all.blocked(ray.origin, ray.origin + (nearest + 0.01) * ray.direction, 1e-4));
  }
}

/// 10 um within a box's rim, where floats have steps of 120 um: the ray still hits the box.
TEST(Scene, RimsFarFromTheOriginAreMet) {
  Rng rng(11, 1, 0);
  Scene scene;
  const Vec3 center(2000.3, -1500.7, 300.2);
  add(scene, box(1, 1, 1), {center, Quat::Identity()});
  // Behind it, so that there is a hierarchy to lose it in.
  for (int i = 1; i < 40; ++i)
    add(scene, box(1, 1, 1), {center - Vec3(3 * i, 0, 0), Quat::Identity()});
  scene.commit();
  for (int i = 0; i < 2000; ++i) {
    const double along = rng.uniform() - 0.5, rim = 0.5 - 1e-5;
    const Vec3 target = center + Vec3(0.5, along, i % 2 == 0 ? rim : -rim);
    const double y = rng.uniform(), z = rng.uniform();
    const Vec3 origin = center + Vec3(8.5, 4 * y - 2, 0.4 * (z - 0.5));
    const Hit hit = cast_one(scene, origin, target - origin);
    ASSERT_NEAR(hit.range, (target - origin).norm(), 1e-9) << i;
    ASSERT_TRUE(scene.blocked(origin, target + 0.01 * (target - origin)));
  }
}

TEST(Scene, ACastMeetsOnlyTheMobilitiesItAsksFor) {
  Scene scene;
  add(scene, box(1, 1, 1), at(6, 0, 0));
  const ShapeId door = add(scene, box(1, 1, 1), at(4, 0, 0), Mobility::kAnchored);
  const ShapeId person = add(scene, box(1, 1, 1), at(2, 0, 0), Mobility::kMoving);
  scene.commit();
  const Ray ahead = ray(Vec3(0, 0, 0), Vec3::UnitX());
  const auto range = [&](Mobilities among) {
    Hit hit;
    scene.cast(&ahead, &hit, 1, among);
    EXPECT_EQ(scene.blocked(Vec3(0, 0, 0), Vec3(5.9, 0, 0), 1e-4, among), hit.range < 5.9);
    return hit.range;
  };
  EXPECT_EQ(range(kAll), 1.5);
  EXPECT_EQ(range(only(Mobility::kStatic) | only(Mobility::kAnchored)), 3.5);
  EXPECT_EQ(range(only(Mobility::kStatic)), 5.5);
  EXPECT_EQ(range(only(Mobility::kMoving)), 1.5);
  EXPECT_EQ(scene.mobility(door.index), Mobility::kAnchored);
  EXPECT_EQ(scene.mobility(person.index), Mobility::kMoving);
  EXPECT_EQ(scene.cast_at(door.index, ahead).range, 3.5);
}

TEST(Scene, AShapeCanBecomeAnchored) {
  Scene scene;
  const ShapeId wall = add(scene, box(1, 1, 1), at(8, 0, 0));
  const ShapeId chair = add(scene, box(1, 1, 1), at(2, 0, 0), Mobility::kMoving);
  scene.commit();
  scene.set_anchored(chair, true);
  scene.set_anchored(wall, true);  // ignored: it is static
  scene.commit();
  EXPECT_EQ(scene.mobility(chair.index), Mobility::kAnchored);
  EXPECT_EQ(scene.mobility(wall.index), Mobility::kStatic);
  EXPECT_TRUE(scene.covered(Vec3(2, 0, 0), UINT32_MAX));
  EXPECT_TRUE(scene.blocked(Vec3(0, 0, 0), Vec3(4, 0, 0), 1e-4, only(Mobility::kAnchored)));
  scene.set_anchored(chair, false);
  scene.commit();
  EXPECT_FALSE(scene.covered(Vec3(2, 0, 0), UINT32_MAX));
  EXPECT_FALSE(scene.blocked(Vec3(0, 0, 0), Vec3(4, 0, 0), 1e-4, only(Mobility::kAnchored)));
}

std::ptrdiff_t threads_of_process() {
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return std::distance(begin(tasks), end(tasks));
}

TEST(Scene, BuildingStartsNoThread) {
  const std::ptrdiff_t before = threads_of_process();
  Scene scene;
  Rng rng(10, 1, 0);
  add(scene, box(1, 99, 99));
  for (int i = 0; i < 20000; ++i) add(scene, random_shape(rng), random_pose(rng, 50.0));
  scene.commit();
  EXPECT_TRUE(cast_one(scene, Vec3(-99, 0, 0), Vec3::UnitX()).hit());  // a cast builds
  EXPECT_EQ(threads_of_process(), before);
}

TEST(Scene, ScenesInSeveralThreadsShareTheDevice) {
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&wrong, t] {
      Scene scene;
      const ShapeId id = add(scene, box(1, 1, 1), at(2, 0, 0), Mobility::kMoving);
      for (int i = 0; i < 500; ++i) {
        scene.move(id, at(2 + i, 0, 0));
        scene.commit();
        if (cast_one(scene, Vec3(0, 0, 0), Vec3::UnitX()).range != 1.5 + i) ++wrong[t];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace angen::rays::testing
