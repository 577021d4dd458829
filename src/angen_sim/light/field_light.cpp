// The part of Field that returns the light on its patches.
#include <algorithm>
#include <utility>

#include "light/field.h"
#include "light/field_rays.h"

namespace angen::light {
namespace {

std::uint32_t place_of_hash(const Solution& solution, std::uint64_t hash) {
  const auto found = std::lower_bound(solution.by_hash.begin(), solution.by_hash.end(),
                                      std::pair<std::uint64_t, std::uint32_t>(hash, 0));
  const bool known = found != solution.by_hash.end() && found->first == hash;
  return known ? found->second : kNoPatch;
}

}  // namespace

std::uint32_t Field::place(const Solution& solution, std::uint32_t patch, bool stale) const {
  const std::uint32_t number = patch - solution.first_patch;  // wraps around below the first
  if (number < solution.places.size()) {
    const std::uint32_t at = solution.places[number];
    if (at != kNoPatch && solution.serials[at] == surfaces_[patch].serial) return at;
  }
  const bool made_since = surfaces_[patch].serial > solution.serials_before;
  return stale && made_since ? place_of_hash(solution, surfaces_[patch].hash) : kNoPatch;
}

bool Field::reaches(const Solution& solution, std::uint32_t patch, bool stale) const {
  return patch == kNoPatch || place(solution, patch, stale) != kNoPatch;
}

float Field::direct(const Solution& solution, std::uint32_t patch, bool stale) const {
  const std::uint32_t at = place(solution, patch, stale);
  return at == kNoPatch ? 0.0F : solution.direct[at];
}

Rgb Field::reflected(const Solution& solution, std::uint32_t patch, bool stale) {
  if (patch == kNoPatch) return Rgb::Zero();
  const std::uint32_t at = place(solution, patch, stale);
  if (at != kNoPatch) return solution.reflected[at];
  if (solution.patches.empty()) return Rgb::Zero();
  // No links are made for a stale solution, so that queries leave no trace; the next solution has
  // them.
  return stale && !counted(patch) ? Rgb(Rgb::Zero()) : cached_indirect(solution, patch, stale);
}

/// One more bounce, from the patches of the solution.
Rgb Field::cached_indirect(const Solution& solution, std::uint32_t patch, bool stale) {
  const std::uint64_t state = 2 * (in_flux() ? ~scene_.revision() : revision_) + (stale ? 1 : 0);
  if (solution.indirect_state != state) solution.indirect_cache.clear();
  solution.indirect_state = state;
  const auto [known, is_new] =
      solution.indirect_cache.try_emplace(surfaces_[patch].hash, Rgb::Zero());
  if (!is_new) return known->second;
  Rgb sum = Rgb::Zero();
  const std::vector<Link>& seen_from = links(patch);
  for (const Link& link : seen_from) {
    if (link.patch == kNoPatch) continue;
    const std::uint32_t seen = place(solution, link.patch, stale);
    if (seen == kNoPatch) continue;
    sum += albedo_of(link.patch) * (solution.direct[seen] + solution.reflected[seen]);
  }
  return known->second = sum / static_cast<float>(seen_from.size());
}

void Field::add_reflected(const Solution& solution, const Rgb& factor,
                          std::vector<Rgb>& light) const {
  light.resize(surfaces_.size(), Rgb::Zero());
  for (std::size_t i = 0; i < solution.patches.size(); ++i) {
    const std::uint32_t patch = solution.patches[i];
    if (surfaces_[patch].serial == solution.serials[i])
      light[patch] += factor * solution.reflected[i];
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
