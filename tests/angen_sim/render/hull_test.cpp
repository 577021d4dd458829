#include "render/hull.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "rays/triangle.h"

namespace angen::render {
namespace {

Eigen::Vector3f random_point(Rng& rng, double size) {
  return (size * Vec3(rng.uniform(), rng.uniform(), rng.uniform())).cast<float>();
}

Box random_box(Rng& rng, double size) {
  const Eigen::Vector3f at = random_point(rng, 4.0);
  return {at, at + random_point(rng, size)};
}

Eigen::Vector3f point_in(Rng& rng, const Box& box) {
  const Eigen::Vector3f share = random_point(rng, 1.0);
  return box.min() + share.cwiseProduct(box.sizes());
}

/// A box as the hull of its corners, turned.
Eigen::Matrix3f random_turn(Rng& rng) {
  return from_rpy(6 * rng.uniform(), 6 * rng.uniform(), 6 * rng.uniform())
      .toRotationMatrix()
      .cast<float>();
}

/// Whether a box overlaps the hull, as the third of four; the others are far away.
bool overlaps(const Hull& hull, const Box& box) {
  const Box far_away = box.translated(Eigen::Vector3f(200.0F, 0.0F, 0.0F));
  Boxes4 boxes;
  for (int i = 0; i < 4; ++i) {
    const Box& each = i == 2 ? box : far_away;
    for (int axis = 0; axis < 3; ++axis) {
      boxes.min[static_cast<std::size_t>(axis)][i] = each.min()[axis];
      boxes.max[static_cast<std::size_t>(axis)][i] = each.max()[axis];
    }
  }
  const Four found = hull.overlaps(boxes);
  EXPECT_EQ(found & ~4U, 0U);
  return found != 0;
}

TEST(Hull, OverlapsEachBoxThatASegmentMeets) {
  Rng rng(1, hash_bytes("hull"), 0);
  int hit = 0, beside = 0;
  for (int i = 0; i < 50000; ++i) {
    const Box from = random_box(rng, 0.01), to = random_box(rng, 1.5), box = random_box(rng, 0.7);
    const Hull hull(from, to);
    const Eigen::Matrix3f turn = random_turn(rng);
    const Eigen::Vector3f place = random_point(rng, 2.0);
    const bool is_near = overlaps(hull, box);
    const bool is_near_turned = overlaps(hull.seen_from(turn, place), box);
    beside += is_near ? 0 : 1;
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3f a = point_in(rng, from), b = point_in(rng, to);
      const Eigen::Vector3f p = a + static_cast<float>(rng.uniform()) * (b - a);
      if (box.contains(p)) {
        ++hit;
        ASSERT_TRUE(is_near);
      }
      const bool hit_turned = box.contains(turn.transpose() * (p - place));
      ASSERT_TRUE(is_near_turned || !hit_turned);
    }
  }
  EXPECT_GT(hit, 500);
  EXPECT_GT(beside, 30000);
}

Box between(const Eigen::Vector3f& low, const Eigen::Vector3f& high) { return {low, high}; }

TEST(Hull, OverlapsNoBoxBesideItsSegments) {
  const Hull hull(between({0, 0, 2}, {0.001F, 0.001F, 2.001F}), between({1, 0, 0}, {2, 1, 0}));
  EXPECT_FALSE(overlaps(hull, between({0.1F, 0, 0.1F}, {0.5F, 1, 0.5F})));  // below
  EXPECT_FALSE(overlaps(hull, between({1.5F, 0, 1.5F}, {2, 1, 2})));        // above
  EXPECT_FALSE(overlaps(hull, between({1, 0.8F, 0.8F}, {1.2F, 1, 1.2F})));  // to the left
  EXPECT_FALSE(overlaps(hull, between({0, 0, -1}, {3, 3, -0.01F})));        // under the floor
  EXPECT_TRUE(overlaps(hull, between({0.7F, 0.2F, 0.9F}, {0.8F, 0.3F, 1})));
}

/// Whether the segment crosses the face, in doubles.
bool crosses(const Face& face, const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const auto at = [&](std::size_t i) -> Vec3 { return face.corners[i].cast<double>(); };
  const Vec3 from = a.cast<double>(), way = (b - a).cast<double>();
  for (std::size_t k = 2; k < face.count; ++k) {
    double range = 0.0;
    if (rays::intersect_triangle(at(0), at(k - 1), at(k), from, way, range) && range > 0.0 &&
        range < 1.0) {
      return true;
    }
  }
  return false;
}

TEST(Hull, OverlapsEachFaceThatASegmentMeets) {
  Rng rng(1, hash_bytes("face"), 0);
  int met = 0, beside = 0;
  for (int i = 0; i < 50000; ++i) {
    const Box from = random_box(rng, 0.01), to = random_box(rng, 1.5);
    Face face;
    face.count = 3;
    for (auto& corner : face.corners) corner = random_point(rng, 4.0);
    const bool overlaps = Hull(from, to).overlaps(face);
    beside += overlaps ? 0 : 1;
    for (int k = 0; k < 20; ++k) {
      if (!crosses(face, point_in(rng, from), point_in(rng, to))) continue;
      ++met;
      ASSERT_TRUE(overlaps);
    }
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(beside, 20000);
}

TEST(Hull, IsCutOnlyByAFaceThatAllSegmentsCross) {
  Rng rng(1, hash_bytes("cut"), 0);
  int cut = 0;
  for (int i = 0; i < 100000; ++i) {
    const Box from = random_box(rng, 0.01), to = random_box(rng, 0.6);
    Face face;
    face.count = 3;
    for (auto& corner : face.corners) corner = random_point(rng, 8.0).array() - 2.0F;
    if (!Hull(from, to).is_cut_by(face)) continue;
    ++cut;
    for (int k = 0; k < 30; ++k) {
      ASSERT_TRUE(crosses(face, point_in(rng, from), point_in(rng, to)));
    }
  }
  EXPECT_GT(cut, 200);
}

TEST(Hull, IsCutByAWallBetween) {
  const Hull hull(between({0, 0, 2}, {0.001F, 0.001F, 2.001F}),
                  between({2, -0.5F, 0}, {2.5F, 0.5F, 0}));
  Face wall{{{{1, -1, 0}, {1, 1, 0}, {1, 1, 2.5F}, {1, -1, 2.5F}}}, 4};
  EXPECT_TRUE(hull.is_cut_by(wall));
  std::reverse(wall.corners.begin(), wall.corners.end());
  EXPECT_TRUE(hull.is_cut_by(wall));
  for (auto& corner : wall.corners) corner.z() -= 1.4F;  // segments pass above it
  EXPECT_FALSE(hull.is_cut_by(wall));
  for (auto& corner : wall.corners) corner += Eigen::Vector3f(1.3F, 0, 1.4F);  // in the box
  EXPECT_FALSE(hull.is_cut_by(wall));
}

}  // namespace
}  // namespace angen::render
