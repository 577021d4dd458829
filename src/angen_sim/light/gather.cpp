#include "light/gather.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "light/beam.h"
#include "light/directions.h"
#include "light/hemisphere.h"
#include "light/shadow.h"

namespace angen::light {
namespace {

constexpr std::size_t kMaxWays = 1024;  // about, from the points of all free movers
constexpr double kGrazing = 0.15;       // least cosine in areas, which are inaccurate below
constexpr std::size_t kStride = 797;    // odd, so that each direction is used once
// Differences of light between neighboring directions that are refined.
constexpr float kStepLux = 2.0F;    // lx
constexpr float kStepShare = 2.0F;  // share of the mean over all directions
constexpr std::uint32_t kNoMover = UINT32_MAX;
constexpr double kGatherMargin = 1e-4;  // m, so that a ray does not hit its own surface
constexpr rays::Mobilities kMovable = rays::kAll & ~rays::only(rays::Mobility::kStatic);

/// Extends the reach by the ray up to `range`.
void extend(Eigen::AlignedBox3d& reach, const rays::Ray& ray, double range) {
  reach.extend(ray.origin);
  if (std::isfinite(range)) {
    reach.extend(ray.origin + range * ray.direction);
  } else {
    make_infinite(reach);
  }
}

}  // namespace

Gather::Gather(const rays::Scene& scene, Field& field, const Pose& pose)
    : scene_(scene), field_(field), pose_(pose), fixed_reach_(pose.position) {
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  for (const Vec3& local : gather_directions()) {
    rays_.push_back({pose.position, (rotation * local).normalized(), kGatherMargin});
  }
  std::vector<rays::Hit> hits(kDirections);
  scene_.cast(rays_.data(), hits.data(), kDirections, rays::only(rays::Mobility::kStatic));
  for (std::size_t i = 0; i < kDirections; ++i) {
    surfaces_.push_back(surface(rays_[i], hits[i]));
    extend(fixed_reach_, rays_[i], hits[i].range);
  }
  for (std::size_t i = 0; i < kDirections; ++i) {
    rays::Hit hit;
    const rays::Ray ray = hits[i].hit() ? next(i) : rays::Ray{};
    if (hits[i].hit()) {
      scene_.cast(&ray, &hit, 1, rays::only(rays::Mobility::kStatic));
      extend(fixed_reach_, ray, hit.range);
    }
    next_ranges_.push_back(static_cast<float>(hit.range));
  }
}

/// One path of light to surface i; the paths of all directions together fill the hemisphere.
rays::Ray Gather::next(std::size_t i) const {
  const Vec3& about_x = gather_directions()[(i * kStride) % kDirections];
  const Vec3 way = frame_about(surfaces_[i].normal) * Vec3(about_x.y(), about_x.z(), about_x.x());
  return {surfaces_[i].position, way.normalized(), kGatherMargin};
}

Gather::Surface Gather::surface(const rays::Ray& ray, const rays::Hit& hit) const {
  Surface out;
  out.range = hit.range;
  out.albedo = Rgb::Zero();
  if (!hit.hit()) return out;
  out.position = ray.origin + hit.range * ray.direction;
  out.normal = hit.normal.cast<double>().normalized();
  out.albedo = albedo(scene_, hit.shape);
  out.shape = hit.shape;
  return out;
}

Gather::Surface Gather::located(const rays::Ray& ray, const rays::Hit& hit) const {
  Surface out = surface(ray, hit);
  if (hit.hit() && scene_.mobility(hit.shape) != rays::Mobility::kMoving) locate(out);
  return out;
}

void Gather::locate(Surface& surface) const {
  surface.patch = field_.patch_at(surface.shape, surface.position, surface.normal);
  surface.serial = surface.patch == kNoPatch ? 0 : field_[surface.patch].serial;
}

/// Looks up patches again that the field has replaced, and lists all.
void Gather::relocate() {
  if (located_ == field_.revision()) return;
  located_ = field_.revision();
  const auto check = [&](Surface& seen) {
    if (seen.shape == UINT32_MAX) return;
    if (!field_.holds(seen.patch, seen.serial)) locate(seen);
  };
  if (movers_known()) {
    for (Mover& mover : movers_) {
      if (mover.anchored) check(mover.surface);
    }
    for (Surface& seen : around_) check(seen);
  } else {
    movers_revision_ = kNever;  // their shapes may have been removed
  }
  std::unordered_map<std::uint32_t, std::uint32_t> slots;
  patches_.clear();
  slots_.clear();
  for (Surface& seen : surfaces_) {
    check(seen);
    const auto [slot, fresh] =
        slots.try_emplace(seen.patch, static_cast<std::uint32_t>(patches_.size()));
    if (fresh) patches_.push_back(seen.patch);
    slots_.push_back(slot->second);
  }
}

bool Gather::movers_known() const { return movers_revision_ == scene_.revision(); }

void Gather::hold_movers(const Eigen::AlignedBox3d& within) {
  if (movers_revision_ != kNever && within.contains(reach_)) movers_revision_ = scene_.revision();
}

void Gather::find_movers() {
  movers_revision_ = scene_.revision();
  reach_ = fixed_reach_;
  movers_.clear();
  std::vector<rays::Ray> rays = rays_;
  std::vector<rays::Hit> hits(kDirections);
  for (std::size_t i = 0; i < kDirections; ++i) rays[i].max = surfaces_[i].range;
  scene_.cast(rays.data(), hits.data(), kDirections, kMovable);
  before_.assign(kDirections, kNoMover);
  for (std::size_t i = 0; i < kDirections; ++i) {
    if (!hits[i].hit()) continue;
    before_[i] = static_cast<std::uint32_t>(movers_.size());
    movers_.push_back(
        {located(rays[i], hits[i]), scene_.mobility(hits[i].shape) == rays::Mobility::kAnchored});
  }
  find_between();
  find_around();
  weigh();
}

void Gather::find_between() {
  between_.assign(kDirections, Rgb::Constant(-1.0F));
  for (std::size_t i = 0; i < kDirections; ++i) {
    if (surfaces_[i].shape == UINT32_MAX) continue;
    rays::Ray ray = next(i);
    ray.max = next_ranges_[i];
    rays::Hit hit;
    scene_.cast(&ray, &hit, 1, rays::only(rays::Mobility::kMoving));
    if (hit.hit()) between_[i] = albedo(scene_, hit.shape);
  }
}

/// Casts rays from points of free movers for the light that they reflect: the more points, the
/// fewer rays each.
void Gather::find_around() {
  around_.clear();
  const auto free = static_cast<std::size_t>(std::count_if(
      movers_.begin(), movers_.end(), [](const Mover& mover) { return !mover.anchored; }));
  ways_ = free <= kMaxWays / 4 ? 4 : free <= kMaxWays / 2 ? 2 : 1;
  unsigned count = 0;
  for (Mover& mover : movers_) {
    if (mover.anchored) continue;
    mover.around = static_cast<std::uint32_t>(around_.size());
    const Eigen::Matrix3d frame = frame_about(mover.surface.normal);
    for (std::size_t k = 0; k < ways_; ++k, ++count) {
      const double u = radical_inverse(count);
      const double v = square_points()[count % kLampPoints].second;
      const rays::Ray ray{mover.surface.position, (frame * cosine_direction(u, v)).normalized(),
                          kGatherMargin};
      rays::Hit hit;
      scene_.cast(&ray, &hit, 1, kStanding);
      extend(reach_, ray, hit.range);
      around_.push_back(located(ray, hit));
    }
  }
}

/// Computes `left_` as in an integrating sphere: free movers absorb a share of the light, by area
/// times absorptance of theirs and of the room's surfaces. Areas are those seen from here; a body's
/// other half counts too. The last two surfaces of a path are computed one by one, so that the
/// share applies to the light of earlier bounces only: the mean albedo's share of all.
void Gather::weigh() {
  double room = 0.0, movers = 0.0, albedos = 0.0;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const bool mover = before_[i] != kNoMover;
    const Surface& seen = mover ? movers_[before_[i]].surface : surfaces_[i];
    albedos += surfaces_[i].albedo.head<3>().mean() / static_cast<double>(kDirections);
    if (!std::isfinite(seen.range)) continue;
    const double leaving = std::max(kGrazing, gather_directions()[i].x());
    const double arriving = std::max(kGrazing, -seen.normal.dot(rays_[i].direction));
    const double area = seen.range * seen.range / (leaving * arriving);
    const double absorbed = area * (1.0 - seen.albedo.head<3>().mean());
    if (mover && !movers_[before_[i]].anchored) {
      movers += 2.0 * absorbed;
    } else {
      room += absorbed;
    }
  }
  const double kept = movers > 0.0 ? room / (room + movers) : 1.0;
  left_ = static_cast<float>(1.0 - albedos * (1.0 - kept));
}

bool Gather::shaded(const Lamp& lamp, const Surface& surface, std::size_t i) const {
  return !sees_one(scene_, lamp, surface.position, surface.normal, i, kMovable);
}

void Gather::find_direct(const Source& source) {
  const Lamp& lamp = source.lamp;
  Received& from = received_[source.id];
  if (from.geometry == source.geometry) return;
  from.geometry = source.geometry;
  from.lit = false;
  from.direct.assign(kDirections, 0.0F);
  for (std::size_t i = 0; i < kDirections; ++i) {
    const Surface& seen = surfaces_[i];
    if ((seen.albedo == 0.0F).all()) continue;
    const double lux = illuminance(lamp, seen.position, seen.normal);
    if (lux > 0.0 && sees_one(scene_, lamp, seen.position, seen.normal, i,
                              rays::only(rays::Mobility::kStatic))) {
      from.direct[i] = static_cast<float>(lux);
      from.lit = true;
    }
  }
}

const Gather::Received& Gather::received(const Source& source) {
  find_direct(source);
  Received& from = received_[source.id];
  if (from.stamp == source.solution.stamp && from.located == located_ &&
      from.stale == source.stale) {
    return from;
  }
  from.stamp = source.solution.stamp;
  from.located = located_;
  from.stale = source.stale;
  std::vector<Rgb> by_patch;
  from.any = from.lit;
  for (const std::uint32_t patch : patches_) {
    by_patch.push_back(reflected_on(field_, source.solution, patch, source.stale));
    from.any = from.any || (by_patch.back() > 0.0F).any();
  }
  from.reflected.clear();
  for (const std::uint32_t slot : slots_) from.reflected.push_back(by_patch[slot]);
  return from;
}

Rgb Gather::on_mover(const Mover& mover, const Source& source, std::size_t i, bool& in_play) const {
  const Lamp& lamp = source.lamp;
  const Solution& solution = source.solution;
  const Surface& seen = mover.surface;
  const double lux = illuminance(lamp, seen.position, seen.normal);
  Rgb direct = Rgb::Zero(), reflected = Rgb::Zero();
  if (lux > 0.0 &&
      sees_one(scene_, lamp, seen.position, seen.normal, i, rays::only(rays::Mobility::kStatic))) {
    in_play = true;
    if (!shaded(lamp, seen, i)) direct += static_cast<float>(lux);
  }
  if (mover.anchored)
    return direct + left_ * reflected_on(field_, solution, seen.patch, source.stale);
  for (std::size_t k = mover.around; k < mover.around + ways_; ++k) {
    const Surface& from = around_[k];
    if (from.patch == kNoPatch) continue;
    const float first = direct_on(field_, solution, from.patch);
    in_play = in_play || first > 0.0F;
    if (first > 0.0F && !shaded(lamp, from, i + k)) reflected += from.albedo * first;
    reflected += left_ * from.albedo * reflected_on(field_, solution, from.patch, source.stale);
  }
  return direct + reflected / static_cast<float>(ways_);
}

/// lx that leave the surface at the ray's end; `coarse` if a free mover is before it.
Rgb Gather::leaving(const rays::Ray& ray, const Source& source, std::size_t i, const Rgb& coarse) {
  rays::Hit hit;
  scene_.cast(&ray, &hit, 1, rays::kAll);
  if (hit.hit() && scene_.mobility(hit.shape) == rays::Mobility::kMoving) return coarse;
  extend(reach_, ray, hit.range);
  const Surface seen = located(ray, hit);
  if ((seen.albedo == 0.0F).all()) return Rgb::Zero();
  const double lux = illuminance(source.lamp, seen.position, seen.normal);
  const bool lit =
      lux > 0.0 && sees_one(scene_, source.lamp, seen.position, seen.normal, i, rays::kAll);
  return seen.albedo * ((lit ? static_cast<float>(lux) : 0.0F) +
                        left_ * reflected_on(field_, source.solution, seen.patch, source.stale));
}

/// Replaces the light of a direction by the mean of finer ones where it varies strongly, as at the
/// edge of a door that is ajar, and follows such edges.
void Gather::refine(const Source& source, std::vector<Rgb>& leaving) {
  float sum = 0.0F, brightest = 0.0F;
  for (const Rgb& light : leaving) {
    sum += light.maxCoeff();
    brightest = std::max(brightest, light.maxCoeff());
  }
  const float step = std::max(kStepLux, kStepShare * sum / static_cast<float>(kDirections));
  if (brightest <= step) return;
  const std::vector<Rgb> coarse = leaving;
  std::vector<std::size_t> edges;
  std::vector<bool> listed(kDirections, false);
  const auto list = [&](std::size_t i) {
    if (!listed[i]) edges.push_back(i);
    listed[i] = true;
  };
  for (std::size_t i = 0; i < kDirections; ++i) {
    for (const std::size_t other : neighbors()[i]) {
      if ((coarse[i] - coarse[other]).abs().maxCoeff() > step) list(i);
    }
  }
  const Eigen::Matrix3d rotation = pose_.rotation.toRotationMatrix();
  for (std::size_t n = 0; n < edges.size(); ++n) {
    const std::size_t i = edges[n];
    Rgb mean = Rgb::Zero(), least = coarse[i], most = coarse[i];
    std::size_t which = i;
    for (const Vec3& local : fine_directions(i)) {
      const rays::Ray ray{pose_.position, (rotation * local).normalized(), kGatherMargin};
      const Rgb light = this->leaving(ray, source, which += kStride, coarse[i]);
      mean += light / static_cast<float>(kFineDirections);
      least = least.min(light);
      most = most.max(light);
    }
    leaving[i] = mean;
    if ((most - least).maxCoeff() <= step) continue;
    for (const std::size_t other : neighbors()[i]) list(other);
  }
}

Gathered Gather::gather(const Source& source, Eigen::AlignedBox3d& reach) {
  if (!movers_known()) find_movers();
  relocate();
  const Lamp& lamp = source.lamp;
  const Received& from = received(source);
  bool in_play = from.any;
  const auto count = static_cast<float>(kDirections);
  std::vector<Rgb> on_movers;  // lx
  Rgb mean = Rgb::Zero();      // mean of those
  for (std::size_t i = 0; i < kDirections; ++i) {
    if (before_[i] == kNoMover) continue;
    on_movers.push_back(on_mover(movers_[before_[i]], source, i, in_play));
    mean += on_movers.back();
  }
  if (!on_movers.empty()) mean /= static_cast<float>(on_movers.size());
  for (std::size_t i = 0; on_movers.empty() && from.any && i < kDirections; ++i) {
    mean += (from.direct[i] + from.reflected[i]) / count;
  }
  std::vector<Rgb> leaving(kDirections, Rgb::Zero());  // lx
  for (std::size_t i = 0; i < kDirections; ++i) {
    if (before_[i] != kNoMover) {
      leaving[i] = movers_[before_[i]].surface.albedo * on_movers[before_[i]];
    } else if (from.any) {
      const bool dark = from.direct[i] == 0.0F || shaded(lamp, surfaces_[i], i);
      const Rgb reflected =
          between_[i].x() < 0.0F ? Rgb(left_ * from.reflected[i]) : Rgb(between_[i] * mean);
      leaving[i] = surfaces_[i].albedo * ((dark ? 0.0F : from.direct[i]) + reflected);
    }
  }
  refine(source, leaving);
  Gathered out;
  const std::vector<float>& weights = view_weights();
  for (std::size_t i = 0; i < kDirections; ++i) {
    out.illuminance += leaving[i] / count;
    out.view += leaving[i] * weights[i];
  }
  reach.extend(reach_);
  if (in_play) extend(reach, lamp);
  return out;
}

}  // namespace angen::light
