// The part of Field that follows added, removed and moved shapes.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "light/field.h"
#include "light/field_rays.h"

namespace angen::light {
namespace {

constexpr double kNear = 1e-3;         // m, closer counts as touching
constexpr double kStill = 5e-5;        // m: smaller motion is ignored; a ray's margin is larger
constexpr double kLargestPatch = 1.5;  // m across
// Measured costs in rays; they decide only how an update is divided into ticks.
constexpr std::int64_t kCostToSkip = 1;     // a patch that sees no change
constexpr std::int64_t kCostToCompare = 6;  // the links of a patch with a box
constexpr std::int64_t kCostToFind = 4;     // one link

/// Slab test of the segment of that range from the ray's origin.
bool passes(const Eigen::AlignedBox3d& box, const rays::Ray& ray, double range) {
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
  const Eigen::AlignedBox3d &a = before->box, &b = now->box;
  return !b.diagonal().allFinite() || ((a.min() - b.min()).cwiseAbs().maxCoeff() < kStill &&
                                       (a.max() - b.max()).cwiseAbs().maxCoeff() < kStill);
}

double area_of(const Eigen::AlignedBox3d& box) {
  const Vec3 size = box.sizes();
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

/// Adds it to one of the boxes if no more rays pass the box around both than each of them.
void add_box(const Eigen::AlignedBox3d& box, std::vector<Eigen::AlignedBox3d>& boxes) {
  for (Eigen::AlignedBox3d& other : boxes) {
    const Eigen::AlignedBox3d both = other.merged(box);
    if (area_of(both) > area_of(other) + area_of(box)) continue;
    other = both;
    return;
  }
  boxes.push_back(box);
}

}  // namespace

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
void Field::forget_near(const Box& box) {
  const Box near(box.min() - Vec3::Constant(kFacing), box.max() + Vec3::Constant(kFacing));
  for (const bool is_static : {true, false}) {
    for (const Known& shape : known_) {
      if (!shape || shape->is_static != is_static || !near.intersects(shape->box)) continue;
      surfaces_.forget_near(shape->id.index, near, releasing_);
    }
  }
}

void Field::start_update() {
  ++revision_;
  updating_ = true;
  updated_ = 0;
  boxes_.clear();
  std::sort(outdated_.begin(), outdated_.end());
  for (const std::uint32_t shape : outdated_) {
    const Box box = std::exchange(been_[shape], Box());
    add_box({box.min() - Vec3::Constant(kNear), box.max() + Vec3::Constant(kNear)}, boxes_);
    surfaces_.forget(shape, releasing_);
    forget_near(box);
  }
  for (const std::uint32_t patch : releasing_) {
    if (patch < patch_links_.size()) patch_links_[patch] = {};
  }
  outdated_.clear();
  drop_uncounted();
}

void Field::drop_uncounted() {
  for (const std::uint32_t patch : uncounted_) {
    if (!counted(patch)) patch_links_[patch].links.clear();
  }
  uncounted_.clear();
}

std::int64_t Field::update(std::int64_t rays) {
  std::int64_t cost = 0;
  for (; updated_ < counted_.size() && cost < rays; ++updated_) {
    cost += update_links(counted_[updated_]);
  }
  if (updated_ < counted_.size()) return cost;
  updating_ = false;
  drop_uncounted();
  ++revision_;
  ++updates_;
  for (const std::uint32_t patch : releasing_) {
    if (patch < patch_links_.size()) patch_links_[patch] = {};
  }
  const auto removed = [&](std::uint32_t patch) { return !counted(patch); };
  counted_.erase(std::remove_if(counted_.begin(), counted_.end(), removed), counted_.end());
  surfaces_.release(releasing_);
  releasing_.clear();
  return cost;
}

/// Returns the cost in rays.
std::int64_t Field::update_links(std::uint32_t patch) {
  if (!patch_links_[patch].counted) return 0;
  std::vector<Box> near;
  for (const Box& box : boxes_) {
    // The patch at a link's end may extend beyond that point.
    const Box grown(box.min() - Vec3::Constant(kLargestPatch),
                    box.max() + Vec3::Constant(kLargestPatch));
    if (patch_links_[patch].reach.intersects(grown)) near.push_back(box);
  }
  if (near.empty()) return kCostToSkip;
  std::int64_t cost = kCostToCompare * static_cast<std::int64_t>(near.size());
  const std::vector<rays::Ray> rays = link_rays(surfaces_[patch]);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Link known = patch_links_[patch].links[i];
    const rays::Ray& again = rays[i];
    const auto passed = [&](const Box& box) { return passes(box, again, known.range + kNear); };
    const bool misses = known.patch == kNoPatch && !std::isfinite(known.range);
    const bool holds = misses || (known.patch != kNoPatch && surfaces_[known.patch].alive);
    if (holds && std::none_of(near.begin(), near.end(), passed)) continue;
    cost += kCostToFind * price_of(patch);
    rays::Hit hit;
    scene_.cast(&again, &hit, 1, kStanding);
    const Link link = link_of(again, hit);
    patch_links_[patch].links[i] = link;
    cost += cost_of_making(link.patch);
    patch_links_[patch].reach.extend(end_of(again, hit.range));
  }
  return cost;
}

}  // namespace angen::light
