#include "light/field.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "light/field_rays.h"

namespace angen::light {
namespace {

constexpr double kNear = 1e-3;   // m, closer counts as touching
constexpr double kStill = 5e-5;  // m: smaller motion is ignored; a ray's margin is larger
constexpr float kRare = 0.1F;    // tried: 0.3 leaves more noise behind doors ajar

using Box = Eigen::AlignedBox3d;

Box grown(const Box& box, double by) {
  return {box.min() - Vec3::Constant(by), box.max() + Vec3::Constant(by)};
}

}  // namespace

/// Slab test.
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

namespace {

/// Whether the shape is the same and has not moved by kStill. An infinite box, a plane's, shows no
/// motion.
bool stays(const std::optional<rays::Standing>& before, const std::optional<rays::Standing>& now) {
  if (!before || !now) return !before && !now;
  if (before->id != now->id || before->is_static != now->is_static) return false;
  const Box &a = before->box, &b = now->box;
  return !b.diagonal().allFinite() || ((a.min() - b.min()).cwiseAbs().maxCoeff() < kStill &&
                                       (a.max() - b.max()).cwiseAbs().maxCoeff() < kStill);
}

struct Sampling {        // how a patch samples what it sees
  float density = 0.0F;  // links per m^2
  float extent = 0.0F;   // m, root of its links times its area
};

Sampling sampling_of(const Patch& patch) {
  const auto count = static_cast<double>(links_of(patch));
  return {static_cast<float>(count / patch.area),
          static_cast<float>(std::sqrt(count * patch.area))};
}

/// Light goes both ways: links to a patch and those back are samples of the same exchange, form
/// factor times area, and rare ones count for both. Of many links the evenly spread ones of one
/// patch are more accurate. Few are to be expected between patches that are far apart for their
/// size; in narrow gaps parts of cells see each other by many.
void set_exchange(const Patch& from, const Patch& to, Field::Link& link) {
  const Sampling own = sampling_of(from), other = sampling_of(to);
  link.is_rare = !(from.is_part() && to.is_part()) &&
                 link.range * link.range > kRare * own.extent * other.extent;
  link.exchange = 1.0F / (link.is_rare ? own.density + other.density : own.density);
}

/// Adds it to one of the boxes if no more rays pass the box around both than each of them.
void add_box(const Box& box, std::vector<Box>& boxes) {
  for (Box& other : boxes) {
    const Box both = other.merged(box);
    if (half_surface(both) > half_surface(other) + half_surface(box)) continue;
    other = both;
    return;
  }
  boxes.push_back(box);
}

}  // namespace

Rgb albedo(const rays::Scene& scene, std::uint32_t shape) {
  Rgb out = Rgb::Zero();
  out.head<3>() = scene.reflectance(shape).array().max(0.0F).min(kLargestAlbedo);
  return out;
}

Rgb Field::albedo_of(std::uint32_t patch) const {
  return albedo(scene(), static_cast<std::uint32_t>(surfaces_[patch].key[0]));
}

Field::Link Field::link_of(const rays::Ray& ray, const rays::Hit& hit) {
  if (!hit.hit()) return {kNoPatch, std::numeric_limits<float>::infinity()};
  return {patch_at(hit.shape, end_of(ray, hit.range), hit.normal.cast<double>()),
          static_cast<float>(hit.range)};
}

/// Weighs one of the patch's own links.
void Field::weigh(std::uint32_t patch, Link& link) const {
  if (link.patch != kNoPatch) set_exchange(surfaces_[patch], surfaces_[link.patch], link);
}

const std::vector<Field::Link>& Field::links(std::uint32_t patch) {
  if (sights_.size() <= patch) sights_.resize(std::max<std::size_t>(patch + 1, surfaces_.size()));
  if (sights_[patch]) return sights_[patch]->links;
  const std::vector<rays::Ray> rays = link_rays(surfaces_[patch]);
  std::array<rays::Hit, kLinks> hits;
  scene().cast(rays.data(), hits.data(), rays.size(), kStanding);
  auto own = std::make_shared<Sight>();
  own->links.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    own->links.push_back(link_of(rays[i], hits[i]));
    weigh(patch, own->links.back());
    own->reach.extend(rays[i].origin);
    own->reach.extend(end_of(rays[i], hits[i].range));
  }
  sights_[patch] = std::move(own);
  return sights_[patch]->links;
}

void Changes::note(std::uint32_t shape, const Box& box, bool is_static,
                   std::vector<Change>& changes) {
  changes.push_back({box, is_static});
  if (been_.size() <= shape) been_.resize(shape + 1);
  if (been_[shape].isEmpty()) outdated_.push_back(shape);
  been_[shape].extend(box);
}

/// Notes the change of a shape among static ones, or among those that are not static.
void Changes::compare(std::uint32_t shape, const Known& now, bool is_static,
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

std::vector<Changes::Change> Changes::follow(const rays::Scene& scene) {
  const bool first = followed_ == 0;  // no shape is known that could have changed
  std::vector<Change> statics, anchored;
  for (const std::uint32_t shape : scene.standing_changes(followed_)) {
    if (known_.size() <= shape) known_.resize(shape + 1);
    Known now = scene.standing(shape);
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

bool Changes::any_in(const Box& box) const {
  return std::any_of(outdated_.begin(), outdated_.end(),
                     [&](std::uint32_t shape) { return box.intersects(been_[shape]); });
}

std::vector<Changes::Moved> Changes::take() {
  std::sort(outdated_.begin(), outdated_.end());
  std::vector<Moved> taken;
  for (const std::uint32_t shape : std::exchange(outdated_, {})) {
    taken.push_back({shape, std::exchange(been_[shape], Box())});
  }
  return taken;
}

/// A shape near a surface may cover or divide its patches. Returns a box around what is forgotten.
Field::Box Field::forget_near(const Box& box, std::vector<std::uint32_t>& gone) {
  const Box near = grown(box, kFacing);
  Box around;
  surfaces_.each_known([&](std::uint32_t shape) {
    const std::optional<rays::Standing> standing = scene().standing(shape);
    if (standing && near.intersects(standing->box))
      surfaces_.forget_near(shape, near, gone, around);
  });
  return around;
}

void Field::update(std::shared_ptr<const rays::Scene> scene,
                   const std::vector<Changes::Moved>& moved) {
  static std::atomic<std::uint64_t> updates{0};
  revision_ = ++updates;
  surfaces_.set_scene(std::move(scene));
  std::vector<Box> changed, touched;
  std::vector<std::uint32_t> gone;
  for (const Changes::Moved& each : moved) {
    const Box box = grown(each.box, kNear);
    add_box(box, changed);
    surfaces_.forget(each.shape, gone);
    add_box(grown(box.merged(forget_near(each.box, gone)), kNear), touched);
  }
  for (const std::uint32_t patch : gone) {
    if (patch < sights_.size()) sights_[patch] = nullptr;
  }
  for (std::uint32_t patch = 0; patch < sights_.size(); ++patch) {
    if (!sights_[patch]) continue;
    const Box& reach = sights_[patch]->reach;
    const auto meets = [&](const Box& box) { return reach.intersects(box); };
    if (std::any_of(touched.begin(), touched.end(), meets)) cast_again(patch, changed);
  }
  surfaces_.release(gone);
}

/// Casts those links again that pass the boxes, or led to a patch that is forgotten.
void Field::cast_again(std::uint32_t patch, const std::vector<Box>& changed) {
  const Sight& before = *sights_[patch];
  std::vector<Box> near;
  std::copy_if(changed.begin(), changed.end(), std::back_inserter(near),
               [&](const Box& box) { return before.reach.intersects(grown(box, kNear)); });
  std::shared_ptr<Sight> own;  // a copy, from the first change on
  const std::vector<rays::Ray> rays = link_rays(surfaces_[patch]);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Link& link = before.links[i];
    const auto passed = [&](const Box& box) { return passes(box, rays[i], link.range + kNear); };
    const bool misses = link.patch == kNoPatch && !std::isfinite(link.range);
    const bool holds = misses || surfaces_.alive(link.patch);
    if (holds && std::none_of(near.begin(), near.end(), passed)) continue;
    if (!own) own = std::make_shared<Sight>(before);
    rays::Hit hit;
    scene().cast(&rays[i], &hit, 1, kStanding);
    own->links[i] = link_of(rays[i], hit);
    weigh(patch, own->links[i]);
    own->reach.extend(end_of(rays[i], hit.range));
  }
  if (own) sights_[patch] = std::move(own);
}

std::vector<ReflectedLight::Piece> Field::pieces(const std::vector<Rgb>& light) const {
  std::vector<ReflectedLight::Piece> all;
  for (std::uint32_t i = 0; i < light.size(); ++i) {
    if (!surfaces_.alive(i)) continue;
    const Patch& patch = surfaces_[i];
    if (!(light[i].head<3>().maxCoeff() > 0.0F)) continue;
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
