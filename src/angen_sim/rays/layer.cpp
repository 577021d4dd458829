#include "rays/layer.h"

#include <cmath>
#include <limits>

#include "rays/query.h"

namespace angen::rays {
namespace {

constexpr std::size_t kMaxLoose = 24;
constexpr double kFloatError = 1e-3;  // m, of a float within 4 km of the origin

void bounds(const RTCBoundsFunctionArguments* args) {
  const auto* solids = static_cast<const Solid*>(args->geometryUserPtr);
  *args->bounds_o = padded(solids[args->primID].box);
}

template <bool fixed>
void intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& q = *reinterpret_cast<SceneQuery*>(args->context);
  const Solid& solid = static_cast<const Solid*>(args->geometryUserPtr)[args->primID];
  if (solid.loose || !q.try_solid(solid, fixed)) return;
  reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar = reach(q.best.range);
}

template <bool fixed>
void occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& q = *reinterpret_cast<SceneQuery*>(args->context);
  const Solid& solid = static_cast<const Solid*>(args->geometryUserPtr)[args->primID];
  Intersection found;
  if (solid.loose || !q.wants(solid, fixed)) return;
  if (!find_hit(solid, q.origin, q.direction, q.min, q.best.range, found)) return;
  q.solid = &solid;
  reinterpret_cast<RTCRay*>(args->ray)->tfar = -std::numeric_limits<float>::infinity();
}

struct Cover {
  RTCPointQueryContext context;  // first, as in SceneQuery
  const std::vector<Solid>* solids;
  Vec3 point;
  std::uint32_t except;
  bool fixed;
  bool found = false;
};

bool query_inside(RTCPointQueryFunctionArguments* args) {
  auto& cover = *static_cast<Cover*>(args->userPtr);
  const Solid& solid = (*cover.solids)[args->primID];
  if (solid.slot == cover.except || !(cover.fixed || solid.anchored)) return false;
  cover.found = cover.found || contains(solid, cover.point);
  return false;  // keeps the query's radius
}

struct Crowd {
  RTCPointQueryContext context;  // first, as in SceneQuery
  const std::vector<Solid>* solids;
  Vec3 point;
  bool fixed;
  std::int64_t tenths = 0;
};

/// Measured; an integer, so that the sum is the same in any order.
std::int64_t tenths_of(const Solid& solid) {
  if (!solid.mesh) return 1;
  return 4 * kTenths + std::llround(0.25 * kTenths * solid.mesh->crossed());
}

bool query_crowd(RTCPointQueryFunctionArguments* args) {
  auto& crowd = *static_cast<Crowd*>(args->userPtr);
  const Solid& solid = (*crowd.solids)[args->primID];
  if (!(crowd.fixed || solid.anchored) || !solid.box.contains(crowd.point)) return false;
  crowd.tenths += tenths_of(solid);
  return false;  // keeps the query's radius
}

/// Visits the solids that a test accepts and whose boxes may intersect a box.
template <class Test>
struct Search {
  RTCPointQueryContext context;  // first, as in SceneQuery
  const std::vector<Solid>* solids;
  const Test* test;
  const std::function<void(const Solid&)>* visit;

  static bool query(RTCPointQueryFunctionArguments* args) {
    const auto& search = *static_cast<Search*>(args->userPtr);
    const Solid& solid = (*search.solids)[args->primID];
    if (!solid.loose && (*search.test)(solid)) (*search.visit)(solid);
    return false;  // keeps the query's radius
  }
};

template <class Test>
void search_in(const Hierarchy& tree, const std::vector<Solid>& solids,
               const Eigen::AlignedBox3d& box, const Test& test,
               const std::function<void(const Solid&)>& visit) {
  Search<Test> search{{}, &solids, &test, &visit};
  rtcInitPointQueryContext(&search.context);
  const Eigen::Vector3f middle = box.center().cast<float>();
  const auto radius = reach(0.5 * box.sizes().norm() + kFloatError);
  RTCPointQuery query{middle.x(), middle.y(), middle.z(), 0.0F, radius};
  rtcPointQuery(tree.scene.get(), &query, &search.context, Search<Test>::query, &search);
}

/// False only where the ray's line misses the ball around the solid's box.
bool is_near(const Solid& solid, const SceneQuery& q) {
  constexpr double kRounding = 1e-6;
  const double radius2 = 0.25 * solid.box.sizes().squaredNorm() * (1.0 + kRounding) + kRounding;
  const Vec3 offset = solid.box.center() - q.origin;
  return !solid.box.isEmpty() && offset.cross(q.direction).squaredNorm() <= radius2 * q.length2;
}

// Embree asserts that coordinates are below 1.8e18.
bool fit_for_embree(const Vec3& v) { return (v.array().abs() < 1e18).all(); }

}  // namespace

bool SceneQuery::prepare(const Vec3& from, const Vec3& towards, double nearest, double farthest,
                         Mobilities among) {
  rtcInitIntersectContext(&context);
  origin = from;
  direction = towards;
  min = std::max(0.0, nearest);
  best.range = farthest;
  rank = UINT64_MAX;
  solid = nullptr;
  this->among = among;
  length2 = direction.squaredNorm();
  return fit_for_embree(origin) && fit_for_embree(direction) && length2 > 1e-30 && min <= farthest;
}

bool SceneQuery::try_solid(const Solid& candidate, bool fixed) {
  Intersection found;
  if (!wants(candidate, fixed)) return false;
  if (!find_hit(candidate, origin, direction, min, best.range, found)) return false;
  const std::uint64_t found_rank = rank_of(candidate.slot, fixed && !candidate.anchored);
  if (found.range == best.range && found_rank >= rank) return false;
  best = found;
  rank = found_rank;
  solid = &candidate;
  return true;
}

Hit SceneQuery::hit() const {
  return {best.range, solid->slot, normal_at(*solid, origin, direction, best).cast<float>()};
}

Layer::Layer(bool fixed)
    : fixed(fixed),
      held(fixed ? only(Mobility::kStatic) : kAll & ~only(Mobility::kStatic)),
      tree_(bounds, fixed ? intersect<true> : intersect<false>,
            fixed ? occluded<true> : occluded<false>) {}

void Layer::commit() {
  unbuilt_ = std::max(unbuilt_.load(), changed_);
  changed_ = Changed::kNothing;
}

void Layer::move(std::uint32_t at) {
  const bool fits = bounded[at].loose || loose_.size() < kMaxLoose;
  change(fits ? Changed::kFewMoved : Changed::kMoved);
  if (!fits || bounded[at].loose) return;
  bounded[at].loose = true;
  loose_.push_back(at);
}

// A query of standing shapes needs no rebuild after moving shapes have moved.
void Layer::prepare(Mobilities among) const {
  const Changed matters = (among & only(Mobility::kMoving)) != 0 ? Changed::kMoved : Changed::kAny;
  if (unbuilt_ < matters) return;
  const std::lock_guard lock(building_);
  if (unbuilt_ < matters) return;
  for (const Solid& solid : bounded) solid.loose = false;
  loose_.clear();
  tree_.build(bounded.data(), bounded.size());
  unbuilt_ = Changed::kNothing;
}

void Layer::nearest(SceneQuery& q) const {
  for (const Solid& plane : planes) q.try_solid(plane, fixed);
  for (const std::uint32_t at : loose_) {
    if (is_near(bounded[at], q)) q.try_solid(bounded[at], fixed);
  }
  if (bounded.empty()) return;
  RTCRayHit ray{};
  aim(ray.ray, q.origin, q.direction, q.min, q.best.range);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(tree_.scene.get(), &q.context, &ray);
}

bool Layer::any(SceneQuery& q) const {
  Intersection found;
  const auto hits = [&](const Solid& solid) {
    return q.wants(solid, fixed) &&
           find_hit(solid, q.origin, q.direction, q.min, q.best.range, found);
  };
  if (std::any_of(planes.begin(), planes.end(), hits)) return true;
  for (const std::uint32_t at : loose_) {
    if (is_near(bounded[at], q) && hits(bounded[at])) return true;
  }
  if (bounded.empty()) return false;
  RTCRay ray{};
  aim(ray, q.origin, q.direction, q.min, q.best.range);
  rtcOccluded1(tree_.scene.get(), &q.context, &ray);
  return q.solid != nullptr;
}

void Layer::find_in(const ShaftHull& hull, const std::function<void(const Solid&)>& visit) const {
  for (const Solid& plane : planes) {
    if (hull.overlaps(plane)) visit(plane);
  }
  for (const std::uint32_t at : loose_) {
    if (hull.overlaps(bounded[at])) visit(bounded[at]);
  }
  if (bounded.empty()) return;
  const auto overlaps = [&](const Solid& solid) { return hull.overlaps(solid); };
  search_in(tree_, bounded, hull.box(), overlaps, visit);
}

void Layer::find_near(const Eigen::AlignedBox3d& box,
                      const std::function<void(const Solid&)>& visit) const {
  if (bounded.empty()) return;
  const auto intersects = [&](const Solid& solid) { return solid.box.intersects(box); };
  search_in(tree_, bounded, box, intersects, visit);
}

bool Layer::covers(const Vec3& point, std::uint32_t except) const {
  if (bounded.empty()) return false;
  Cover cover;
  rtcInitPointQueryContext(&cover.context);
  cover.solids = &bounded;
  cover.point = point;
  cover.except = except;
  cover.fixed = fixed;
  const Eigen::Vector3f at = point.cast<float>();
  RTCPointQuery query{at.x(), at.y(), at.z(), 0.0F, 2 * static_cast<float>(kSkin)};
  rtcPointQuery(tree_.scene.get(), &query, &cover.context, query_inside, &cover);
  return cover.found;
}

std::int64_t Layer::crowd(const Vec3& point) const {
  if (bounded.empty()) return 0;
  Crowd crowd;
  rtcInitPointQueryContext(&crowd.context);
  crowd.solids = &bounded;
  crowd.point = point;
  crowd.fixed = fixed;
  const Eigen::Vector3f at = point.cast<float>();
  RTCPointQuery query{at.x(), at.y(), at.z(), 0.0F, 1e-5F};  // m, the rounding of floats
  rtcPointQuery(tree_.scene.get(), &query, &crowd.context, query_crowd, &crowd);
  return crowd.tenths;
}

}  // namespace angen::rays
