#include "rays/shaft.h"

#include <algorithm>
#include <utility>

#include "core/random.h"
#include "rays/layer.h"
#include "rays/silhouette.h"
#include "rays/solid.h"

namespace angen::rays {
namespace {

constexpr double kRounding = 1e-6;  // m

bool is_convex(const Solid& solid) {
  return solid.type != Shape::Type::kMesh && solid.type != Shape::Type::kPlane;
}

double farthest(const Eigen::AlignedBox3d& box, const Vec3& point) {
  return (point - box.min()).cwiseAbs().cwiseMax((point - box.max()).cwiseAbs()).norm();
}

}  // namespace

ShaftHull::ShaftHull(const Vec3& from, double near, const Eigen::AlignedBox3d& to)
    : from_(from), near_(near), box_(to) {
  box_.extend(from);
  for (int i = 0; i < 8; ++i) {
    corners_[static_cast<std::size_t>(i)] =
        to.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
  }
  for (const auto& [u, v] : {std::pair{0, 1}, {1, 2}, {2, 0}}) add_sides(u, v);
}

// Seen along an axis, the hull has two sides through the point and a corner, with all other
// corners inward of them; none if the point is within the box.
void ShaftHull::add_sides(int u, int v) {
  const auto part = [&](const Vec3& p) {
    return Eigen::Vector2d(p[u] - from_[u], p[v] - from_[v]);
  };
  each_silhouette<double>(part(corners_[0]), part(corners_[7]),
                          [&](const Eigen::Vector2d& outward) {
                            Side& side = sides_[side_count_++];
                            side.outward.setZero();
                            side.outward[u] = outward.x();
                            side.outward[v] = outward.y();
                            side.offset = side.outward.dot(from_);
                          });
}

bool ShaftHull::is_beside(const Eigen::AlignedBox3d& box) const {
  for (std::size_t i = 0; i < side_count_; ++i) {
    const Side& side = sides_[i];
    const Vec3 inmost = (side.outward.array() > 0.0).select(box.min(), box.max());
    if (side.outward.dot(inmost) > side.offset + kRounding) return true;
  }
  return false;
}

// A box that is turned has less room than the box around it.
bool ShaftHull::is_beside_faces(const Solid& solid) const {
  const Eigen::AlignedBox3d own = own_box(solid);
  const auto to_own = [&](const Vec3& p) -> Vec3 {
    return solid.rotation.transpose() * (p - solid.position);
  };
  Eigen::AlignedBox3d hull(to_own(from_));
  for (const Vec3& corner : corners_) hull.extend(to_own(corner));
  return ((hull.min().array() > own.max().array() + kRounding) ||
          (hull.max().array() < own.min().array() - kRounding))
      .any();
}

bool ShaftHull::overlaps(const Solid& solid) const {
  if (solid.type == Shape::Type::kPlane) return !is_beside_faces(solid);
  if (solid.box.isEmpty() || !solid.box.intersects(box_)) return false;
  if (is_beside(solid.box) || farthest(solid.box, from_) < near_) return false;
  return solid.aligned || !is_beside_faces(solid);
}

// With c the corners and o = from + t (c - from) a point of the solid on the way to each, where
// t < 1, the way to any point of the box, a mean of the corners with weights w, passes the mean of
// the o with weights in proportion to w / t, which is in the solid as it is convex.
bool ShaftHull::is_cut_by(const Solid& solid) const {
  if (!is_convex(solid) || solid.box.exteriorDistance(from_) <= near_) return false;
  return std::all_of(corners_.begin(), corners_.end(), [&](const Vec3& corner) {
    Intersection hit;
    return find_hit(solid, from_, corner - from_, 0.0, 1.0 - kRounding, hit);
  });
}

Shaft::Shaft(const ShaftHull& hull, Blocker target, std::vector<Blocker> blockers)
    : hull_(hull), target_(target), blockers_(std::move(blockers)) {}

std::uint64_t Shaft::fingerprint() const {
  std::uint64_t sum = 0;
  for (const Blocker& each : blockers_) {
    sum += Rng(each.solid->placed, each.solid->slot, 0).next();
  }
  return sum;
}

std::uint32_t Shaft::blocked_by() const {
  const auto found = std::find_if(blockers_.begin(), blockers_.end(), [&](const Blocker& each) {
    return hull_.is_cut_by(*each.solid);
  });
  return found == blockers_.end() ? UINT32_MAX : found->solid->slot;
}

bool Shaft::reaches(const Ray& ray) const {
  Intersection hit;
  return find_hit(*target_.solid, ray.origin, ray.direction, std::max(0.0, ray.min), ray.max, hit);
}

bool Shaft::sees(const Ray& ray) const {
  SceneQuery q;
  if (!q.prepare(ray, kAll) || !q.try_solid(*target_.solid, target_.fixed)) return false;
  return std::none_of(blockers_.begin(), blockers_.end(),
                      [&](const Blocker& each) { return q.try_solid(*each.solid, each.fixed); });
}

}  // namespace angen::rays
