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
constexpr double kRare = 0.1;         // tried: 0.3 leaves more noise behind doors ajar
constexpr double kSettled = 1e-4;     // of the mean: a change that ends the bounces
constexpr int kMaxBounces = 200;
// Costs of the parts of a solution, measured; they decide only how it is cut into ticks.
constexpr std::int64_t kSumsPerRay = 500;
constexpr std::int64_t kRowsPerRay = kSumsPerRay / kLinks;  // patches in balance()
constexpr std::int64_t kCostToMake = 64;                    // a patch
constexpr std::int64_t kBouncesToPrepare = 4;
constexpr std::size_t kFirstAtOnce = 64;

double reach_of(const Lamp& lamp) {
  if (lamp.type == Lamp::Type::kDirectional) return std::numeric_limits<double>::infinity();
  return kReach * std::max(1.0, std::sqrt(lamp.luminous_flux / 800.0));
}

std::uint32_t place_of(std::uint32_t patch, const Unfinished& work) {
  return patch < work.places.size() ? work.places[patch] : kNoPatch;
}

/// Adds a patch to the solution, unless it contains the patch.
void reach_patch(std::uint32_t patch, Unfinished& work) {
  if (patch == kNoPatch || place_of(patch, work) != kNoPatch) return;
  if (work.places.size() <= patch) work.places.resize(patch + 1 + patch / 2, kNoPatch);
  work.places[patch] = static_cast<std::uint32_t>(work.solution.patches.size());
  work.solution.patches.push_back(patch);
}

/// The end of the rows from `first` on that `rays` pay for, of `count` in all.
std::size_t rows_from(std::size_t first, std::size_t count, std::int64_t rays) {
  const auto left = static_cast<std::int64_t>(count - first);
  const std::int64_t affordable = std::clamp<std::int64_t>(rays, 1, left / kRowsPerRay + 1);
  return first + static_cast<std::size_t>(std::min(left, affordable * kRowsPerRay));
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
    if (lux > 0.0 && sees_one(scene_, lamp, site.position, i + on.hash % kLampPoints, kStanding)) {
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
    const std::uint32_t place = place_of(link.patch, work);
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
    if (link.patch == kNoPatch || place_of(link.patch, work) != kNoPatch || !near(link.patch)) {
      continue;
    }
    reach_patch(link.patch, work);
  }
}

/// Links of a patch per m^2.
float Field::density_of(std::uint32_t patch) {
  return static_cast<float>(static_cast<double>(links(patch).size()) / surfaces_[patch].area);
}

/// Whether few links are to be expected between the patches. In narrow gaps parts of cells see each
/// other by many.
bool Field::is_rare(std::uint32_t from, const Link& to) {
  if (surfaces_[from].is_part() && surfaces_[to.patch].is_part()) return false;
  const auto extent2 = [&](std::uint32_t patch) {
    return static_cast<double>(links(patch).size()) * surfaces_[patch].area;
  };
  return to.range * to.range > kRare * std::sqrt(extent2(from) * extent2(to.patch));
}

/// Lists the patches that the next patches see. As light goes both ways, links to a patch and those
/// back are samples of the same exchange, form factor times area, and rare ones count for both. Of
/// many links the evenly spread ones of one patch are more accurate.
std::int64_t Field::prepare_balance(Unfinished& work, std::int64_t rays) {
  const Solution& solution = work.solution;
  const auto count = static_cast<std::uint32_t>(solution.patches.size());
  std::size_t i = work.albedos.size();
  const std::size_t first = i;
  const std::size_t end = rows_from(first, count, rays / kBouncesToPrepare);
  work.wholes.resize(count + 1, 0.0F);
  work.arriving.resize(count + 1, Rgb::Zero());
  for (; i < end; ++i) {
    work.albedos.push_back(albedo_of(solution.patches[i]));
    work.leaving[i] = work.albedos[i] * (solution.direct[i] + solution.reflected[i]);
    const float density = density_of(solution.patches[i]);
    work.rows.push_back(work.seen.size());
    for (const Link& link : links(solution.patches[i])) {
      const std::uint32_t place = std::min(count, place_of(link.patch, work));
      const bool both_ways = place < count && is_rare(solution.patches[i], link);
      const float exchange = 1.0F / (both_ways ? density + density_of(link.patch) : density);
      const std::uint32_t back = both_ways ? place : count;
      work.seen.push_back(place);
      work.seen_by.push_back(back);
      work.exchanges.push_back(exchange);
      work.wholes[i] += exchange;
      work.wholes[back] += exchange;
      work.arriving[back] += work.leaving[i] * exchange;
    }
  }
  if (i == count) {
    work.rows.push_back(work.seen.size());
    work.leaving.push_back(Rgb::Zero());  // for links without a patch
  }
  return 1 + static_cast<std::int64_t>(i - first) * kBouncesToPrepare / kRowsPerRay;
}

/// Continues a bounce: a Gauss-Seidel step of the radiosity equation for each patch.
std::int64_t Field::balance(Unfinished& work, std::int64_t rays) {
  Solution& solution = work.solution;
  const std::size_t first = work.balanced;
  const std::size_t end = rows_from(first, solution.patches.size(), rays);
  for (std::size_t i = first; i < end; ++i) {
    Rgb sum = work.arriving[i];
    for (std::size_t k = work.rows[i]; k < work.rows[i + 1]; ++k) {
      sum += work.exchanges[k] * work.leaving[work.seen[k]];
    }
    sum /= work.wholes[i];
    work.change = std::max(work.change, (sum - solution.reflected[i]).abs().maxCoeff());
    work.total += solution.direct[i] + sum.maxCoeff();
    solution.reflected[i] = sum;
    const Rgb leaving = work.albedos[i] * (solution.direct[i] + sum);
    const Rgb more = leaving - std::exchange(work.leaving[i], leaving);
    for (std::size_t k = work.rows[i]; k < work.rows[i + 1]; ++k) {
      work.arriving[work.seen_by[k]] += work.exchanges[k] * more;
    }
  }
  work.balanced = end;
  return 1 + static_cast<std::int64_t>(end - first) / kRowsPerRay;
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
  while (work.albedos.size() < patches.size()) {
    if (!take(prepare_balance(work, rays))) return false;
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
