#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "light/field.h"
#include "light/lamp.h"

namespace angen::light {

/// Light of one white lamp at level 1 on the patches that it reaches, directly or by reflections on
/// static and anchored surfaces.
struct Solution {
  std::vector<std::uint32_t> patches;
  std::vector<std::uint64_t> serials;
  std::uint32_t first_patch = 0;      // the lowest of `patches`
  std::vector<std::uint32_t> places;  // their indices, by patch - first_patch; or kNoPatch
  std::vector<float> direct;          // lx
  std::vector<Rgb> reflected;         // lx, from other patches
  Eigen::AlignedBox3d bounds;         // bounds of the patches and the lamp
  std::uint64_t stamp = 0;            // unique
  // lx that other patches receive from these; valid for one revision of the field.
  mutable std::unordered_map<std::uint32_t, Rgb> indirect_cache;
  mutable std::uint64_t indirect_revision = 0;
};

/// A lamp, its solution for an earlier scene or null, and the shapes that have moved since.
struct Unsolved {
  const Lamp& lamp;
  const Solution* known = nullptr;
  const std::vector<Changes::Moved>& moved;
};

/// Balances the light of each lamp between the patches of a field (radiosity), on several threads.
/// The same scene and lamp give the same light, whatever the field was used for before, and
/// whatever is known.
std::vector<std::shared_ptr<const Solution>> solve(const std::vector<Unsolved>& lamps,
                                                   Field& field);

/// The light of one lamp of which nothing is known, found on this thread; null once `stop` is set.
std::shared_ptr<const Solution> solve(const Lamp& lamp, Field& field,
                                      const std::atomic<bool>& stop);

/// lx on a patch directly from the lamp; 0 if the solution does not contain the patch.
float direct_on(const Field& field, const Solution& solution, std::uint32_t patch);

/// lx on a patch from other patches. A patch within the bounds of the solution that it does not
/// contain receives one more bounce, unless it is `stale`: shapes have moved since.
Rgb reflected_on(Field& field, const Solution& solution, std::uint32_t patch, bool stale);

/// Adds the solution's reflected lx times `factor` to `light`, by patch.
void add_reflected(const Field& field, const Solution& solution, const Rgb& factor,
                   std::vector<Rgb>& light);

}  // namespace angen::light
