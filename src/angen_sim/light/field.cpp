#include "light/field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "light/field_rays.h"

namespace angen::light {
namespace {

constexpr double kNear = 1e-3;         // m, closer counts as touching
constexpr double kStill = 5e-5;        // m: smaller motion is ignored; a ray's margin is larger
constexpr double kLargestPatch = 1.5;  // m across

using Box = Eigen::AlignedBox3d;

Box grown(const Box& box, double by) {
  return {box.min() - Vec3::Constant(by), box.max() + Vec3::Constant(by)};
}

/// Slab test of the segment of that range from the ray's origin.
bool passes(const Box& box, const rays::Ray& ray, double range) {
  double enter = 0.0, leave = range;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / ray.direction[axis];
    const double a = (box.min()[axis] - ray.origin[axis]) * inverse;
    const double b = (box.max()[axis] - ray.origin[axis]) * inverse;
    if (std::isnan(a) || std::isnan(b)) continue;  // along a face: counts as within
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

/// Whether the shape is the same and has not moved by kStill. An infinite box, a plane's, shows no
/// motion.
bool stays(const std::optional<rays::Standing>& before, const std::optional<rays::Standing>& now) {
  if (!before || !now) return !before && !now;
  if (before->id != now->id || before->is_static != now->is_static) return false;
  const Box &a = before->box, &b = now->box;
  return !b.diagonal().allFinite() || ((a.min() - b.min()).cwiseAbs().maxCoeff() < kStill &&
                                       (a.max() - b.max()).cwiseAbs().maxCoeff() < kStill);
}

double area_of(const Box& box) {
  const Vec3 size = box.sizes();
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

/// Adds it to one of the boxes if no more rays pass the box around both than each of them.
void add_box(const Box& box, std::vector<Box>& boxes) {
  for (Box& other : boxes) {
    const Box both = other.merged(box);
    if (area_of(both) > area_of(other) + area_of(box)) continue;
    other = both;
    return;
  }
  boxes.push_back(box);
}

}  // namespace

Rgb Field::albedo(std::uint32_t shape) const {
  Rgb out = Rgb::Zero();
  out.head<3>() = scene_.reflectance(shape).array().max(0.0F).min(kLargestAlbedo);
  return out;
}

Rgb Field::albedo_of(std::uint32_t patch) const {
  return albedo(static_cast<std::uint32_t>(surfaces_[patch].key[0]));
}

Field::Link Field::link_of(const rays::Ray& ray, const rays::Hit& hit) {
  if (!hit.hit()) return {kNoPatch, std::numeric_limits<float>::infinity()};
  return {patch_at(hit.shape, end_of(ray, hit.range), hit.normal.cast<double>()),
          static_cast<float>(hit.range)};
}

const std::vector<Field::Link>& Field::links(std::uint32_t patch) {
  static_assert(std::is_nothrow_move_constructible_v<Sight>,
                "a growing vector would copy all lists");
  if (sights_.size() <= patch) sights_.resize(std::max<std::size_t>(patch + 1, surfaces_.size()));
  if (!sights_[patch].links.empty()) return sights_[patch].links;
  const std::vector<rays::Ray> rays = link_rays(surfaces_[patch]);
  std::array<rays::Hit, kLinks> hits;
  scene_.cast(rays.data(), hits.data(), rays.size(), kStanding);
  Sight& own = sights_[patch];
  own.reach.setEmpty();
  own.links.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    own.links.push_back(link_of(rays[i], hits[i]));
    own.reach.extend(rays[i].origin);
    own.reach.extend(end_of(rays[i], hits[i].range));
  }
  return own.links;
}

void Field::note(std::uint32_t shape, const Box& box, bool is_static,
                 std::vector<Change>& changes) {
  changes.push_back({box, is_static});
  if (been_.size() <= shape) been_.resize(shape + 1);
  if (been_[shape].isEmpty()) outdated_.push_back(shape);
  been_[shape].extend(box);
}

/// Notes the change of a shape among static ones, or among those that are not static.
void Field::compare(std::uint32_t shape, const Known& now, bool is_static,
                    std::vector<Change>& changes) {
  const Known& before = known_[shape];
  const bool was = before && before->is_static == is_static;
  const bool is = now && now->is_static == is_static;
  if (was && is) {
    note(shape, before->box.merged(now->box), is_static, changes);
  } else if (was) {
    note(shape, before->box, is_static, changes);
  } else if (is) {
    note(shape, now->box, is_static, changes);
  }
}

std::vector<Field::Change> Field::follow() {
  const bool first = followed_ == 0;  // no shape is known that could have changed
  std::vector<Change> statics, anchored;
  for (const std::uint32_t shape : scene_.standing_changes(followed_)) {
    if (known_.size() <= shape) known_.resize(shape + 1);
    Known now = scene_.standing(shape);
    if (stays(known_[shape], now)) continue;  // known_ keeps the old box, so that creeping adds up
    if (!first) {
      compare(shape, now, true, statics);
      compare(shape, now, false, anchored);
    }
    known_[shape] = std::move(now);
  }
  statics.insert(statics.end(), anchored.begin(), anchored.end());
  return statics;
}

bool Field::outdated_in(const Box& box) const {
  return std::any_of(outdated_.begin(), outdated_.end(),
                     [&](std::uint32_t shape) { return box.intersects(been_[shape]); });
}

/// A shape near a surface may cover or divide its patches.
void Field::forget_near(const Box& box, std::vector<std::uint32_t>& gone) {
  const Box near = grown(box, kFacing);
  for (const bool is_static : {true, false}) {
    for (const Known& shape : known_) {
      if (!shape || shape->is_static != is_static || !near.intersects(shape->box)) continue;
      surfaces_.forget_near(shape->id.index, near, gone);
    }
  }
}

void Field::update() {
  if (outdated_.empty()) return;
  ++revision_;
  std::vector<Box> changed;
  std::vector<std::uint32_t> gone;
  std::sort(outdated_.begin(), outdated_.end());
  for (const std::uint32_t shape : outdated_) {
    const Box box = std::exchange(been_[shape], Box());
    add_box(grown(box, kNear), changed);
    surfaces_.forget(shape, gone);
    forget_near(box, gone);
  }
  outdated_.clear();
  for (const std::uint32_t patch : gone) {
    if (patch < sights_.size()) sights_[patch] = {};
  }
  for (std::uint32_t patch = 0; patch < sights_.size(); ++patch) cast_again(patch, changed);
  surfaces_.release(gone);
}

/// Casts those links again that pass the boxes.
void Field::cast_again(std::uint32_t patch, const std::vector<Box>& changed) {
  Sight& own = sights_[patch];
  if (own.links.empty()) return;
  std::vector<Box> near;
  for (const Box& box : changed) {
    // The patch at a link's end may extend beyond that point.
    if (own.reach.intersects(grown(box, kLargestPatch))) near.push_back(box);
  }
  if (near.empty()) return;
  const std::vector<rays::Ray> rays = link_rays(surfaces_[patch]);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Link& link = own.links[i];
    const auto passed = [&](const Box& box) { return passes(box, rays[i], link.range + kNear); };
    const bool misses = link.patch == kNoPatch && !std::isfinite(link.range);
    const bool holds = misses || (link.patch != kNoPatch && surfaces_[link.patch].alive);
    if (holds && std::none_of(near.begin(), near.end(), passed)) continue;
    rays::Hit hit;
    scene_.cast(&rays[i], &hit, 1, kStanding);
    link = link_of(rays[i], hit);
    own.reach.extend(end_of(rays[i], hit.range));
  }
}

std::vector<ReflectedLight::Piece> Field::pieces(const std::vector<Rgb>& light) const {
  std::vector<ReflectedLight::Piece> all;
  for (std::uint32_t i = 0; i < light.size(); ++i) {
    const Patch& patch = surfaces_[i];
    if (!patch.alive || patch.sites.empty() || !(light[i].head<3>().maxCoeff() > 0.0F)) continue;
    Vec3 position = Vec3::Zero(), normal = Vec3::Zero();
    for (const Site& site : patch.sites) {
      position += site.position;
      normal += site.normal;
    }
    position /= static_cast<double>(patch.sites.size());
    all.push_back({position.cast<float>(), normal.normalized().cast<float>(), light[i].head<3>()});
  }
  return all;
}

}  // namespace angen::light
