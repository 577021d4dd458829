#include "light/field.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "core/random.h"
#include "light/beam.h"
#include "light/directions.h"

namespace angen::light {
namespace {

constexpr std::size_t kLinks = 128;    // directions in which a patch gathers
constexpr std::size_t kFans = 32;      // ways to spread them
constexpr std::size_t kFirst = 2048;   // rays that find what a lamp shines on
constexpr std::size_t kLattice = 128;  // rays along a side of the world that find what the sun does
constexpr double kMargin = 1e-4;       // m, a surface does not meet its own rays
constexpr double kNear = 1e-3;         // m, as near as touches
constexpr double kFarthest = 1e4;      // m
constexpr double kReach = 15.0;  // m that the reflected light of an 800 lm lamp is followed from it
constexpr float kDark = 2e-4F;   // lx: what throws back less is not followed farther
constexpr double kBeyondSites = 0.5;  // m
constexpr double kSettled = 1e-4;     // of the mean: a change that ends the bounces
constexpr int kMostBounces = 200;
// Costs of the parts of a solution, measured; they decide only how it is cut into ticks.
constexpr std::size_t kSumsPerRay = 500;
constexpr std::size_t kBouncesToPrepare = 4;

/// Directions for one patch's links, about z, and which of its sites each starts from.
struct Fan {
  std::array<Vec3, kLinks> directions;
  std::array<std::size_t, kLinks> sites;
};

std::vector<Fan> make_fans() {
  std::vector<Fan> fans(kFans);
  for (std::size_t f = 0; f < kFans; ++f) {
    Rng rng(0, hash_bytes("light links"), static_cast<std::int64_t>(f));
    const double shift_u = rng.uniform(), shift_v = rng.uniform();
    for (std::size_t i = 0; i < kLinks; ++i) {
      const double u = (static_cast<double>(i) + 0.5) / kLinks + shift_u;
      const double v = radical_inverse(static_cast<unsigned>(i)) + shift_v;
      fans[f].directions[i] = cosine_direction(u - std::floor(u), v - std::floor(v));
      fans[f].sites[i] = i;
    }
    for (std::size_t i = kLinks - 1; i > 0; --i) {
      std::swap(fans[f].sites[i], fans[f].sites[rng.next() % (i + 1)]);
    }
  }
  return fans;
}

const std::vector<Fan>& fans() {
  static const std::vector<Fan> all = make_fans();
  return all;
}

rays::Ray ray_from(const Vec3& origin, const Vec3& direction) {
  rays::Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.min = kMargin;
  return ray;
}

Vec3 end_of(const rays::Ray& ray, double range) {
  return ray.origin + std::min(range, kFarthest) * ray.direction;
}

/// Slabs, over the segment from the ray's origin.
bool passes(const Eigen::AlignedBox3d& box, const rays::Ray& ray, double range) {
  double enter = 0.0, leave = std::min(range, kFarthest);
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

double reach_of(const Lamp& lamp) {
  if (lamp.type == Lamp::Type::kDirectional) return kFarthest;
  return kReach * std::max(1.0, std::sqrt(lamp.luminous_flux / 800.0));
}

/// Rays that find what a lamp shines on.
std::vector<rays::Ray> first_rays(const Lamp& lamp, const Eigen::AlignedBox3d& world) {
  std::vector<rays::Ray> rays;
  const Vec3 shines = lamp.pose.rotation * lamp.direction;
  const Eigen::Matrix3d frame = frame_about(shines);
  if (lamp.type == Lamp::Type::kDirectional) {
    const Vec3 middle = world.isEmpty() ? Vec3::Zero() : Vec3(world.center());
    const double half = world.isEmpty() ? 1.0 : world.diagonal().norm() / 2;
    for (std::size_t i = 0; i < kLattice * kLattice; ++i) {
      const double u = 2.0 * (static_cast<double>(i % kLattice) + 0.5) / kLattice - 1.0;
      const double v = 2.0 * (static_cast<double>(i / kLattice) + 0.5) / kLattice - 1.0;
      rays.push_back(ray_from(middle + half * (frame * Vec3(u, v, -1.0)), shines));
    }
    return rays;
  }
  for (std::size_t i = 0; i < kFirst; ++i) {
    const double u = (static_cast<double>(i) + 0.5) / kFirst;
    const double v = radical_inverse(static_cast<unsigned>(i));
    if (lamp.flat()) {
      rays.push_back(ray_from(lamp_point(lamp, i), frame * cosine_direction(u, v)));
      continue;
    }
    const double z = 1.0 - 2.0 * u, around = std::sqrt(1.0 - z * z), angle = 2.0 * M_PI * v;
    const Vec3 way(around * std::cos(angle), around * std::sin(angle), z);
    if (beam(lamp, lamp.pose.position + way).illuminance > 0.0) {
      rays.push_back(ray_from(lamp.pose.position, way));
    }
  }
  return rays;
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

bool Field::follow(std::vector<Eigen::AlignedBox3d>& touched) {
  if (static_revision_ != scene_.static_revision()) {
    surfaces_.clear();
    sights_.clear();
    anchored_ = scene_.anchored();
    static_revision_ = scene_.static_revision();
    anchored_revision_ = scene_.anchored_revision();
    return false;
  }
  if (anchored_revision_ == scene_.anchored_revision()) return true;
  anchored_revision_ = scene_.anchored_revision();
  Anchored now = scene_.anchored();
  const auto without = [&](const Anchored& all, const Anchored& others) {
    for (const auto& [id, box] : all) {
      const auto other = std::lower_bound(
          others.begin(), others.end(), id.index,
          [](const auto& each, std::uint32_t index) { return each.first.index < index; });
      if (other != others.end() && other->first == id && other->second.isApprox(box, 0.0)) continue;
      for (const std::uint32_t patch : surfaces_.forget(id.index)) {
        if (patch < sights_.size()) sights_[patch] = {};
      }
      touched.push_back({box.min() - Vec3::Constant(kNear), box.max() + Vec3::Constant(kNear)});
    }
  };
  without(anchored_, now);
  without(now, anchored_);
  anchored_ = std::move(now);
  update_links(touched);
  return true;
}

rays::Ray Field::ray(std::uint32_t patch, std::size_t link) const {
  const Patch& from = surfaces_[patch];
  const Fan& fan = fans()[from.hash % kFans];
  // Each patch turns its fan about the normal by an angle of its own.
  const double angle = 2.0 * M_PI * static_cast<double>(from.hash >> 40) / (1 << 24);
  const Site& site = from.sites[fan.sites[link] % from.sites.size()];
  const Vec3& d = fan.directions[link];
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec3 turned(c * d.x() - s * d.y(), s * d.x() + c * d.y(), d.z());
  return ray_from(site.position, (frame_about(site.normal) * turned).normalized());
}

Field::Link Field::link_of(const rays::Ray& ray, const rays::Hit& hit) {
  if (!hit.hit()) return {kNoPatch, std::numeric_limits<float>::infinity()};
  return {patch_at(hit.shape, end_of(ray, hit.range), hit.normal.cast<double>()),
          static_cast<float>(hit.range)};
}

const std::vector<Field::Link>& Field::links(std::uint32_t patch) {
  if (sights_.size() <= patch) sights_.resize(std::max<std::size_t>(patch + 1, surfaces_.size()));
  if (!sights_[patch].links.empty()) return sights_[patch].links;
  std::array<rays::Ray, kLinks> rays;
  std::array<rays::Hit, kLinks> hits;
  for (std::size_t i = 0; i < kLinks; ++i) rays[i] = ray(patch, i);
  scene_.cast(rays.data(), hits.data(), kLinks, kStanding);
  Sight& sight = sights_[patch];
  for (std::size_t i = 0; i < kLinks; ++i) {
    sight.links.push_back(link_of(rays[i], hits[i]));
    sight.reach.extend(rays[i].origin);
    sight.reach.extend(end_of(rays[i], hits[i].range));
  }
  return sight.links;
}

void Field::update_links(const std::vector<Eigen::AlignedBox3d>& touched) {
  for (std::uint32_t patch = 0; patch < sights_.size(); ++patch) {
    Sight& sight = sights_[patch];
    if (sight.links.empty()) continue;
    for (const Eigen::AlignedBox3d& box : touched) {
      if (!sight.reach.intersects(box)) continue;
      for (std::size_t i = 0; i < kLinks; ++i) {
        const rays::Ray again = ray(patch, i);
        if (!passes(box, again, sight.links[i].range + kNear)) continue;
        rays::Hit hit;
        scene_.cast(&again, &hit, 1, kStanding);
        sight.links[i] = link_of(again, hit);
        sight.reach.extend(end_of(again, hit.range));
      }
    }
  }
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
  Solution& solution = work.solution;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t patch = link_of(work.first[work.cast + i], hits[i]).patch;
    if (patch == kNoPatch) continue;
    const auto place = static_cast<std::uint32_t>(solution.patches.size());
    if (solution.places.try_emplace(patch, place).second) solution.patches.push_back(patch);
  }
  work.cast += count;
  return count;
}

/// Follows the light from patch to patch as far as it matters; returns how many rays it cast.
std::size_t Field::spread(Unfinished& work, std::size_t rays) {
  std::size_t count = 0;
  for (; work.followed < work.solution.patches.size() && count < rays; ++work.followed) {
    const std::uint32_t patch = work.solution.patches[work.followed];
    if (sights_.size() <= patch || sights_[patch].links.empty()) count += kLinks;
    count += surfaces_[patch].sites.size();
    follow_patch(work);
  }
  return count;
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
    const auto place = solution.places.find(link.patch);
    if (place != solution.places.end() && place->second < i) sum += work.leaving[place->second];
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
    if (link.patch == kNoPatch || solution.places.count(link.patch) != 0 || !near(link.patch)) {
      continue;
    }
    solution.places.emplace(link.patch, static_cast<std::uint32_t>(solution.patches.size()));
    solution.patches.push_back(link.patch);
  }
}

void Field::prepare_balance(Unfinished& work) {
  const Solution& solution = work.solution;
  const auto count = static_cast<std::uint32_t>(solution.patches.size());
  std::vector<std::uint32_t> places(surfaces_.size(), count);
  for (std::uint32_t i = 0; i < count; ++i) places[solution.patches[i]] = i;
  work.seen.reserve(count * kLinks);
  for (std::size_t i = 0; i < count; ++i) {
    work.albedos.push_back(albedo_of(solution.patches[i]));
    work.leaving[i] = work.albedos[i] * (solution.direct[i] + solution.reflected[i]);
    for (const Link& link : links(solution.patches[i])) {
      work.seen.push_back(link.patch == kNoPatch ? count : places[link.patch]);
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
  static std::atomic<std::uint64_t> stamps{0};
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
  if (work.lamp.type != Lamp::Type::kDirectional) {
    solution.bounds.extend(work.lamp.pose.position);
  }
  for (const std::uint32_t patch : solution.patches) {
    for (const Site& site : surfaces_[patch].sites) solution.bounds.extend(site.position);
  }
  // A patch goes on beyond its outermost sites.
  solution.bounds.min().array() -= kBeyondSites;
  solution.bounds.max().array() += kBeyondSites;
  solution.valid = true;
  solution.stamp = ++stamps;
  return true;
}

Solution Field::solve(const Lamp& lamp) {
  Unfinished work(lamp);
  advance(work, SIZE_MAX);
  return std::move(work.solution);
}

float Field::direct(const Solution& solution, std::uint32_t patch) const {
  const auto place = solution.places.find(patch);
  return place == solution.places.end() ? 0.0F : solution.direct[place->second];
}

Rgb Field::reflected(const Solution& solution, std::uint32_t patch) {
  if (patch == kNoPatch) return Rgb::Zero();
  const auto place = solution.places.find(patch);
  if (place != solution.places.end()) return solution.reflected[place->second];
  const auto [known, is_new] = solution.beyond.try_emplace(patch, Rgb::Zero());
  if (!is_new) return known->second;
  Rgb sum = Rgb::Zero();
  for (const Link& link : links(patch)) {
    const auto seen = solution.places.find(link.patch);
    if (seen == solution.places.end()) continue;
    sum +=
        albedo_of(link.patch) * (solution.direct[seen->second] + solution.reflected[seen->second]);
  }
  return known->second = sum / static_cast<float>(kLinks);
}

}  // namespace angen::light
