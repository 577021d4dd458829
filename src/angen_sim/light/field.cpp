#include "light/field.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "light/beam.h"
#include "light/directions.h"
#include "light/field_rays.h"
#include "light/shadow.h"

namespace angen::light {
namespace {

constexpr double kReach = 15.0;       // m around an 800 lm lamp, in which its light is followed
constexpr float kDark = 1e-3F;        // lx: less reflected light is not followed
constexpr double kBeyondSites = 0.5;  // m
constexpr double kSettled = 1e-4;     // share of the mean: a change that ends the bounces
constexpr int kMaxBounces = 200;
// Costs of the parts of a solution, measured; they decide only how it is cut into ticks.
constexpr std::int64_t kCostToMake = 64;  // a patch
constexpr std::size_t kFirstAtOnce = 64;

double reach_of(const Lamp& lamp) {
  if (lamp.type == Lamp::Type::kDirectional) return std::numeric_limits<double>::infinity();
  return kReach * std::max(1.0, std::sqrt(lamp.luminous_flux / 800.0));
}

/// Adds a patch to the solution, unless it contains the patch.
void reach_patch(std::uint32_t patch, Unfinished& work) {
  if (patch == kNoPatch || work.place_of(patch) != kNoPatch) return;
  if (work.places.size() <= patch) work.places.resize(patch + 1 + patch / 2, kNoPatch);
  work.places[patch] = static_cast<std::uint32_t>(work.solution.patches.size());
  work.solution.patches.push_back(patch);
}

std::uint64_t next_stamp() {
  static std::atomic<std::uint64_t> stamps{0};
  return ++stamps;
}

void number_places(Solution& solution) {
  if (solution.patches.empty()) return;
  const auto [low, high] = std::minmax_element(solution.patches.begin(), solution.patches.end());
  solution.first_patch = *low;
  solution.places.assign(*high - *low + 1, kNoPatch);
  for (std::uint32_t i = 0; i < solution.patches.size(); ++i) {
    solution.places[solution.patches[i] - *low] = i;
  }
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

std::uint32_t Field::patch_at(std::uint32_t shape, const Vec3& point, const Vec3& normal) {
  return surfaces_.at(shape, point, normal);
}

Field::Link Field::link_of(const rays::Ray& ray, const rays::Hit& hit) {
  if (!hit.hit()) return {kNoPatch, std::numeric_limits<float>::infinity()};
  return {patch_at(hit.shape, end_of(ray, hit.range), hit.normal.cast<double>()),
          static_cast<float>(hit.range)};
}

const std::vector<Field::Link>& Field::links(std::uint32_t patch) {
  static_assert(std::is_nothrow_move_constructible_v<PatchLinks>,
                "a growing vector would copy all lists");
  if (patch_links_.size() <= patch)
    patch_links_.resize(std::max<std::size_t>(patch + 1, surfaces_.size()));
  // Links that are not counted are not kept: while shapes change they are found again.
  const PatchLinks& known = patch_links_[patch];
  if (!known.links.empty() && (known.counted || !in_flux() || known.scene == scene_.revision())) {
    return known.links;
  }
  const std::vector<rays::Ray> rays = link_rays(surfaces_[patch]);
  std::array<rays::Hit, kLinks> hits;
  scene_.cast(rays.data(), hits.data(), rays.size(), kStanding);
  PatchLinks& own = patch_links_[patch];
  own.scene = scene_.revision();
  own.reach.setEmpty();
  own.links.clear();
  own.links.reserve(rays.size());
  if (!own.counted) uncounted_.push_back(patch);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    own.links.push_back(link_of(rays[i], hits[i]));
    own.reach.extend(rays[i].origin);
    own.reach.extend(end_of(rays[i], hits[i].range));
  }
  return own.links;
}

float Field::direct(const Lamp& lamp, std::uint32_t patch) const {
  const Patch& on = surfaces_[patch];
  double sum = 0.0;
  for (std::size_t i = 0; i < on.sites.size(); ++i) {
    const Site& site = on.sites[i];
    const double lux = illuminance(lamp, site.position, site.normal);
    if (lux > 0.0 &&
        sees_one(scene_, lamp, site.position, site.normal, i + on.hash % kLampPoints, kStanding)) {
      sum += lux;
    }
  }
  return static_cast<float>(sum / static_cast<double>(on.sites.size()));
}

/// Finds the directly lit patches; returns its cost in rays, as all these parts do.
std::int64_t Field::start(Unfinished& work, std::int64_t rays) {
  std::array<rays::Hit, kFirstAtOnce> hits;
  std::int64_t cost = 0;
  while (work.cast < work.first.size() && cost < rays) {
    const std::size_t count = std::min(kFirstAtOnce, work.first.size() - work.cast);
    const rays::Ray* first = work.first.data() + work.cast;
    scene_.cast(first, hits.data(), count, kStanding);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t patch = link_of(first[i], hits[i]).patch;
      cost += price_of(patch) + cost_of_making(patch);
      reach_patch(patch, work);
    }
    work.cast += count;
  }
  return cost;
}

/// Follows the light from patch to patch, within kReach and kDark.
std::int64_t Field::spread(Unfinished& work, std::int64_t rays) {
  std::int64_t cost = 0;
  for (; work.followed < work.solution.patches.size() && cost < rays; ++work.followed) {
    const std::uint32_t patch = work.solution.patches[work.followed];
    cost +=
        cost_of(patch) + price_of(patch) * static_cast<std::int64_t>(surfaces_[patch].sites.size());
    follow_patch(work);
  }
  return cost;
}

std::int64_t Field::cost_of_making(std::uint32_t patch) {
  if (patch == kNoPatch) return 0;
  if (patch_links_.size() <= patch)
    patch_links_.resize(std::max<std::size_t>(patch + 1, surfaces_.size()));
  return std::exchange(patch_links_[patch].made, true) ? 0 : kCostToMake * price_of(patch);
}

/// The cost of a ray from the patch or to it.
std::int64_t Field::price_of(std::uint32_t patch) {
  if (patch == kNoPatch) return 1;
  if (patch_links_.size() <= patch)
    patch_links_.resize(std::max<std::size_t>(patch + 1, surfaces_.size()));
  std::int64_t& price = patch_links_[patch].price;
  if (price == 0) price = scene_.price(surfaces_[patch].sites.front().position);
  return price;
}

std::int64_t Field::cost_of(std::uint32_t patch) {
  if (patch == kNoPatch || counted(patch)) return 0;
  const std::size_t count = links(patch).size();
  patch_links_[patch].counted = true;
  counted_.push_back(patch);
  const std::int64_t least = price_of(patch);
  std::int64_t cost = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t seen = patch_links_[patch].links[i].patch;
    cost += std::max(least, price_of(seen)) + cost_of_making(seen);
  }
  return cost;
}

/// Computes the light on a patch; its first guess of reflected light is that of the patches before
/// it.
void Field::follow_patch(Unfinished& work) {
  Solution& solution = work.solution;
  const std::size_t i = work.followed;
  const std::uint32_t patch = solution.patches[i];
  const std::vector<Link>& seen = links(patch);
  Rgb sum = Rgb::Zero();
  for (const Link& link : seen) {
    const std::uint32_t place = work.place_of(link.patch);
    if (place < i) sum += work.leaving[place];
  }
  solution.direct.push_back(direct(work.lamp, patch));
  solution.reflected.push_back(sum / static_cast<float>(seen.size()));
  work.leaving.push_back(albedo_of(patch) * (solution.direct[i] + solution.reflected[i]));
  if (work.leaving[i].maxCoeff() < kDark) return;
  const double reach = reach_of(work.lamp);
  const auto near = [&](std::uint32_t other) {
    const Vec3& at = surfaces_[other].sites.front().position;
    return work.lamp.type == Lamp::Type::kDirectional
               ? work.world.squaredExteriorDistance(at) < kReach * kReach
               : (at - work.lamp.pose.position).norm() < reach;
  };
  for (const Link& link : seen) {
    if (link.patch == kNoPatch || work.place_of(link.patch) != kNoPatch || !near(link.patch)) {
      continue;
    }
    reach_patch(link.patch, work);
  }
}

bool Field::advance(Unfinished& work, std::int64_t& rays) {
  const std::vector<std::uint32_t>& patches = work.solution.patches;
  const auto take = [&rays](std::int64_t cost) {
    rays -= cost;
    return rays > 0;
  };
  if (work.first.empty()) {
    work.world = scene_.static_bounds();
    work.first = first_rays(work.lamp, work.world);
    work.solution.serials_before = surfaces_.serials();
  }
  if (work.cast < work.first.size() && !take(start(work, rays))) return false;
  if (work.followed < patches.size() && !take(spread(work, rays))) return false;
  while (work.samplings.size() < patches.size()) {
    if (!take(list_samplings(work, rays))) return false;
  }
  while (work.arrived < patches.size()) {
    if (!take(list_arrivals(work, rays))) return false;
  }
  while (work.rows.size() <= patches.size()) {
    if (!take(list_exchanges(work, rays))) return false;
  }
  while (!patches.empty() && work.bounces < kMaxBounces) {
    const bool within = take(balance(work, rays));
    if (work.balanced < patches.size()) return false;
    ++work.bounces;
    work.balanced = 0;
    const double mean = std::exchange(work.total, 0.0) / static_cast<double>(patches.size());
    if (std::exchange(work.change, 0.0F) <= kSettled * mean) break;
    if (!within) return false;
  }
  finish(work);
  return true;
}

void Field::finish(Unfinished& work) {
  Solution& solution = work.solution;
  if (work.lamp.type != Lamp::Type::kDirectional) {
    solution.bounds.extend(work.lamp.pose.position);
  }
  solution.by_hash.reserve(solution.patches.size());
  for (std::uint32_t i = 0; i < solution.patches.size(); ++i) {
    const Patch& patch = surfaces_[solution.patches[i]];
    solution.by_hash.emplace_back(patch.hash, i);
    solution.serials.push_back(patch.serial);
    for (const Site& site : patch.sites) solution.bounds.extend(site.position);
  }
  std::sort(solution.by_hash.begin(), solution.by_hash.end());
  solution.patches.shrink_to_fit();
  solution.direct.shrink_to_fit();
  solution.reflected.shrink_to_fit();
  number_places(solution);
  // A patch extends beyond its outermost sites.
  solution.bounds.min().array() -= kBeyondSites;
  solution.bounds.max().array() += kBeyondSites;
  solution.stamp = next_stamp();
}

Solution Field::outline(const Lamp& lamp, std::int64_t& rays) const {
  Solution out;
  out.outlined = true;
  if (lamp.type != Lamp::Type::kDirectional) out.bounds.extend(lamp.pose.position);
  const std::vector<rays::Ray> first = first_rays(lamp, scene_.static_bounds());
  std::vector<rays::Hit> hits(first.size());
  scene_.cast(first.data(), hits.data(), first.size(), kStanding);
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (hits[i].hit()) out.bounds.extend(end_of(first[i], hits[i].range));
  }
  out.bounds.min().array() -= kBeyondSites;
  out.bounds.max().array() += kBeyondSites;
  out.stamp = next_stamp();
  rays -= static_cast<std::int64_t>(first.size());
  return out;
}

}  // namespace angen::light
