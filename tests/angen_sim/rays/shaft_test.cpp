// The rays of a shaft have the answers of a cast among all shapes.
#include "rays/shaft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/random.h"
#include "shapes.h"

namespace angen::rays::testing {
namespace {

constexpr double kNear = 0.05;  // m
constexpr double kRim = 2e-3;   // m, of a target: what only reaches there counts as beside it

bool on_rim(const Eigen::AlignedBox3d& box, const Vec3& point) {
  return (point - box.min()).cwiseMin(box.max() - point).minCoeff() < kRim * 1.001;
}

struct Answers {
  int clear = 0;
  int blocked = 0;
  int partly = 0;  // some rays arrive, others do not

  void check(const Scene& scene, const Vec3& from, ShapeId target, Rng& rng) {
    const Shaft shaft = scene.shaft(from, kNear, target.index);
    const Eigen::AlignedBox3d box = scene.bounds(target);
    int seen = 0;
    int hidden = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3 share = 0.5 * (random_point(rng, 1.0) + Vec3::Ones());
      Ray r = ray(from, box.min() + share.cwiseProduct(box.sizes()) - from);
      r.min = kNear;
      const Hit own = scene.cast_at(target.index, r);
      EXPECT_EQ(shaft.reaches(r), own.hit());
      if (!own.hit() || on_rim(box, from + own.range * r.direction)) continue;
      const bool expected = cast_one(scene, r).shape == target.index;
      ++(expected ? seen : hidden);
      EXPECT_EQ(shaft.sees(r), expected);
      EXPECT_TRUE(expected || !shaft.clear());
      EXPECT_TRUE(!expected || shaft.blocked_by() == UINT32_MAX);
    }
    if (shaft.clear()) ++clear;
    if (shaft.blocked_by() != UINT32_MAX) {
      ++blocked;
      EXPECT_TRUE(scene.blocks(shaft.blocked_by(), from, kNear, target.index));
    }
    if (seen > 0 && hidden > 0) ++partly;
  }
};

TEST(Shaft, ItsRaysAreThoseOfACastAmongAllShapes) {
  Answers found;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng(seed, hash_bytes("shaft"), 0);
    Scene scene;
    std::vector<ShapeId> movers;
    add(scene, plane(), at(0, 0, -3));
    for (int i = 0; i < 12; ++i) add(scene, random_shape(rng), random_pose(rng, 4.0));
    add(scene, box(0.2, 4, 4), random_pose(rng, 3.0));
    for (int i = 0; i < 6; ++i) {
      movers.push_back(add(scene, random_shape(rng), random_pose(rng, 4.0), Mobility::kMoving));
    }
    scene.commit();
    for (int turn = 0; turn < 4; ++turn) {
      for (const ShapeId target : movers) {
        const Vec3 from = random_point(rng, 5.0);
        const Eigen::AlignedBox3d box = scene.bounds(target);
        if (box.isEmpty() || box.exteriorDistance(from) < kNear) continue;
        found.check(scene, from, target, rng);
      }
      for (const ShapeId mover : movers) scene.move(mover, random_pose(rng, 4.0));
      scene.commit();
    }
  }
  EXPECT_GT(found.clear, 100);
  EXPECT_GT(found.blocked, 30);
  EXPECT_GT(found.partly, 100);
}

TEST(Shaft, AWallWithAGapDoesNotBlockIt) {
  Scene scene;
  const ShapeId ball = add(scene, round(Shape::Type::kSphere, 0.2), at(4, 0, 0));
  add(scene, box(0.1, 2, 2), at(2, 1.02, 0));
  const ShapeId other = add(scene, box(0.1, 2, 2), at(2, -1.02, 0), Mobility::kMoving);
  scene.commit();
  EXPECT_EQ(scene.shaft(Vec3::Zero(), kNear, ball.index).blocked_by(), UINT32_MAX);
  EXPECT_TRUE(scene.shaft(Vec3::Zero(), kNear, ball.index).sees(ray({0, 0, 0}, {1, 0, 0})));
  scene.move(other, at(2, 0.5, 0));
  scene.commit();
  EXPECT_EQ(scene.shaft(Vec3::Zero(), kNear, ball.index).blocked_by(), other.index);
  EXPECT_TRUE(scene.blocks(other.index, Vec3::Zero(), kNear, ball.index));
  EXPECT_FALSE(scene.blocks(UINT32_MAX, Vec3::Zero(), kNear, ball.index));
  EXPECT_FALSE(scene.blocks(other.index, Vec3(3, 0, 0), kNear, ball.index)) << "it is behind";
  scene.remove(other);
  scene.commit();
  EXPECT_FALSE(scene.blocks(other.index, Vec3::Zero(), kNear, ball.index));
}

TEST(Shaft, ADetectorsOwnHousingIsNotInIt) {
  Scene scene;
  const ShapeId ball = add(scene, round(Shape::Type::kSphere, 0.2), at(4, 0, 0));
  const Quat turned = from_rpy(0.0, 0.3, 0.7);
  add(scene, round(Shape::Type::kSphere, 0.02), {turned * Vec3(0.025, 0, 0), turned});
  add(scene, box(0.04, 0.2, 0.2), at(0, 0, 0, turned));
  scene.commit();
  EXPECT_FALSE(scene.shaft(Vec3::Zero(), kNear, ball.index).clear());
  EXPECT_TRUE(scene.shaft(turned * Vec3(0.03, 0, 0), kNear, ball.index).clear());
}

TEST(Shaft, HasAFingerprintOfItsBlockersAndTheirPoses) {
  Scene scene;
  const ShapeId ball = add(scene, round(Shape::Type::kSphere, 0.2), at(4, 0, 0));
  const ShapeId post = add(scene, box(0.1, 0.1, 2), at(2, 0.1, 0), Mobility::kMoving);
  const ShapeId beside = add(scene, box(0.1, 0.1, 2), at(2, 3, 0), Mobility::kMoving);
  const auto number = [&] {
    scene.commit();
    return scene.shaft(Vec3::Zero(), kNear, ball.index).fingerprint();
  };
  const std::uint64_t first = number();
  scene.move(beside, at(2, 4, 0));
  EXPECT_EQ(number(), first);
  scene.move(post, at(2, 0.11, 0));
  EXPECT_NE(number(), first);
  scene.remove(post);
  EXPECT_EQ(number(), 0U);
}

}  // namespace
}  // namespace angen::rays::testing
