#include "light/field.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "light/beam.h"
#include "light/field_rays.h"

namespace angen::light {
namespace {

constexpr double kReach = 15.0;  // m that the reflected light of an 800 lm lamp is followed from it
constexpr float kDark = 1e-3F;   // lx: what throws back less is not followed farther
constexpr double kBeyondSites = 0.5;  // m
constexpr double kSettled = 1e-4;     // of the mean: a change that ends the bounces
constexpr int kMostBounces = 200;
// Costs of the parts of a solution, measured; they decide only how it is cut into ticks.
constexpr std::size_t kSumsPerRay = 500;
constexpr std::size_t kCostToMake = 128;  // a patch
constexpr std::size_t kBouncesToPrepare = 4;

double reach_of(const Lamp& lamp) {
  if (lamp.type == Lamp::Type::kDirectional) return std::numeric_limits<double>::infinity();
  return kReach * std::max(1.0, std::sqrt(lamp.luminous_flux / 800.0));
}

std::uint32_t place_of(std::uint32_t patch, const Unfinished& work) {
  return patch < work.places.size() ? work.places[patch] : kNoPatch;
}

/// Puts a patch on the solution's list, unless it is there.
void reach_patch(std::uint32_t patch, Unfinished& work) {
  if (patch == kNoPatch || place_of(patch, work) != kNoPatch) return;
  if (work.places.size() <= patch) work.places.resize(patch + 1 + patch / 2, kNoPatch);
  work.places[patch] = static_cast<std::uint32_t>(work.solution.patches.size());
  work.solution.patches.push_back(patch);
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
  if (sights_.size() <= patch) sights_.resize(std::max<std::size_t>(patch + 1, surfaces_.size()));
  if (!sights_[patch].links.empty()) return sights_[patch].links;
  const std::array<rays::Ray, kLinks> rays = link_rays(surfaces_[patch]);
  std::array<rays::Hit, kLinks> hits;
  scene_.cast(rays.data(), hits.data(), kLinks, kStanding);
  Sight& sight = sights_[patch];
  sight.links.reserve(kLinks);
  for (std::size_t i = 0; i < kLinks; ++i) {
    sight.links.push_back(link_of(rays[i], hits[i]));
    sight.reach.extend(rays[i].origin);
    sight.reach.extend(end_of(rays[i], hits[i].range));
  }
  return sight.links;
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

/// Finds what the lamp shines on; returns how many rays it cast.
std::size_t Field::start(Unfinished& work, std::size_t rays) {
  const std::size_t count = std::min(rays, work.first.size() - work.cast);
  std::vector<rays::Hit> hits(count);
  scene_.cast(work.first.data() + work.cast, hits.data(), count, kStanding);
  for (std::size_t i = 0; i < count; ++i) {
    reach_patch(link_of(work.first[work.cast + i], hits[i]).patch, work);
  }
  work.cast += count;
  return count;
}

/// Follows the light from patch to patch as far as it matters; returns how many rays it cast.
std::size_t Field::spread(Unfinished& work, std::size_t rays) {
  std::size_t count = 0;
  for (; work.followed < work.solution.patches.size() && count < rays; ++work.followed) {
    count += cost_of(work.solution.patches[work.followed]);
    follow_patch(work);
  }
  return count;
}

/// In rays. Does not depend on who has measured what.
std::size_t Field::cost_of(std::uint32_t patch) {
  const std::size_t sites = surfaces_[patch].sites.size();
  links(patch);
  return std::exchange(sights_[patch].charged, true) ? sites : kCostToMake + kLinks + sites;
}

/// The light that a patch gets, with a first guess of what comes from others: what those before it
/// throw back.
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
  solution.reflected.push_back(sum / static_cast<float>(kLinks));
  work.leaving.push_back(albedo_of(patch) * (solution.direct[i] + solution.reflected[i]));
  if (work.leaving[i].maxCoeff() < kDark) return;
  const double reach = reach_of(work.lamp);
  const Eigen::AlignedBox3d world = scene_.static_bounds();
  const auto near = [&](std::uint32_t other) {
    const Vec3& at = surfaces_[other].sites.front().position;
    return work.lamp.type == Lamp::Type::kDirectional
               ? world.squaredExteriorDistance(at) < kReach * kReach
               : (at - work.lamp.pose.position).norm() < reach;
  };
  for (const Link& link : seen) {
    if (link.patch == kNoPatch || place_of(link.patch, work) != kNoPatch || !near(link.patch)) {
      continue;
    }
    reach_patch(link.patch, work);
  }
}

void Field::prepare_balance(Unfinished& work) {
  const Solution& solution = work.solution;
  const auto count = static_cast<std::uint32_t>(solution.patches.size());
  work.seen.reserve(count * kLinks);
  for (std::size_t i = 0; i < count; ++i) {
    work.albedos.push_back(albedo_of(solution.patches[i]));
    work.leaving[i] = work.albedos[i] * (solution.direct[i] + solution.reflected[i]);
    for (const Link& link : links(solution.patches[i])) {
      work.seen.push_back(std::min(count, place_of(link.patch, work)));
    }
  }
  work.leaving.push_back(Rgb::Zero());  // the dark
}

/// One bounce: each patch takes what it sees of the others, of those before it what they throw back
/// by now (Gauss and Seidel). True when no patch's light has changed.
bool Field::bounce(Unfinished& work) {
  Solution& solution = work.solution;
  const std::size_t count = solution.patches.size();
  float change = 0.0F;
  double total = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    Rgb sum = Rgb::Zero();
    const std::uint32_t* row = &work.seen[i * kLinks];
    for (std::size_t k = 0; k < kLinks; ++k) sum += work.leaving[row[k]];
    sum /= static_cast<float>(kLinks);
    change = std::max(change, (sum - solution.reflected[i]).abs().maxCoeff());
    total += solution.direct[i] + sum.maxCoeff();
    solution.reflected[i] = sum;
    work.leaving[i] = work.albedos[i] * (solution.direct[i] + sum);
  }
  return change <= kSettled * total / static_cast<double>(count);
}

bool Field::advance(Unfinished& work, std::size_t rays) {
  Solution& solution = work.solution;
  const auto take = [&rays](std::size_t cost) { rays -= std::min(rays, cost); };
  if (work.first.empty()) work.first = first_rays(work.lamp, scene_.static_bounds());
  if (work.cast < work.first.size()) take(start(work, rays));
  if (work.cast < work.first.size() || rays == 0) return false;
  if (work.followed < solution.patches.size()) take(spread(work, rays));
  if (work.followed < solution.patches.size() || rays == 0) return false;
  const std::size_t cost = 1 + solution.patches.size() * kLinks / kSumsPerRay;
  if (!work.balancing) {
    prepare_balance(work);
    work.balancing = true;
    take(kBouncesToPrepare * cost);
  }
  for (;; take(cost)) {
    if (rays == 0) return false;
    if (bounce(work) || ++work.bounces == kMostBounces) break;
  }
  finish(work);
  return true;
}

void Field::finish(Unfinished& work) {
  static std::atomic<std::uint64_t> stamps{0};
  Solution& solution = work.solution;
  if (work.lamp.type != Lamp::Type::kDirectional) {
    solution.bounds.extend(work.lamp.pose.position);
  }
  for (std::uint32_t i = 0; i < solution.patches.size(); ++i) {
    const Patch& patch = surfaces_[solution.patches[i]];
    solution.places.emplace(patch.serial, i);
    for (const Site& site : patch.sites) solution.bounds.extend(site.position);
  }
  // A patch goes on beyond its outermost sites.
  solution.bounds.min().array() -= kBeyondSites;
  solution.bounds.max().array() += kBeyondSites;
  solution.stamp = ++stamps;
}

Solution Field::solve(const Lamp& lamp) {
  Unfinished work(lamp);
  advance(work, SIZE_MAX);
  return std::move(work.solution);
}

float Field::direct(const Solution& solution, std::uint32_t patch) const {
  const auto place = solution.places.find(surfaces_[patch].serial);
  return place == solution.places.end() ? 0.0F : solution.direct[place->second];
}

Rgb Field::reflected(const Solution& solution, std::uint32_t patch) {
  if (patch == kNoPatch) return Rgb::Zero();
  const auto place = solution.places.find(surfaces_[patch].serial);
  if (place != solution.places.end()) return solution.reflected[place->second];
  Rgb sum = Rgb::Zero();
  for (const Link& link : links(patch)) {
    if (link.patch == kNoPatch) continue;
    const auto seen = solution.places.find(surfaces_[link.patch].serial);
    if (seen == solution.places.end()) continue;
    sum +=
        albedo_of(link.patch) * (solution.direct[seen->second] + solution.reflected[seen->second]);
  }
  return sum / static_cast<float>(kLinks);
}

}  // namespace angen::light
