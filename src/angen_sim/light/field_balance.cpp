// The part of Field that balances light between patches.
#include <algorithm>
#include <cmath>
#include <utility>

#include "light/field.h"
#include "light/field_rays.h"

namespace angen::light {
namespace {

constexpr float kRare = 0.1F;  // tried: 0.3 leaves more noise behind doors ajar
// Costs, measured; they decide only how a solution is cut into ticks.
constexpr std::int64_t kSumsPerRay = 500;
constexpr std::int64_t kRowsPerRay = kSumsPerRay / kLinks;  // patches in balance()
constexpr std::int64_t kBouncesToList = 3;                  // arrivals
constexpr std::int64_t kBouncesToMerge = 10;                // exchanges

/// The end of the rows from `first` on that `rays` pay for, of `count` in all.
std::size_t rows_from(std::size_t first, std::size_t count, std::int64_t rays) {
  const auto left = static_cast<std::int64_t>(count - first);
  const std::int64_t affordable = std::clamp<std::int64_t>(rays, 1, left / kRowsPerRay + 1);
  return first + static_cast<std::size_t>(std::min(left, affordable * kRowsPerRay));
}

/// Whether few links are to be expected between two patches that far apart, m. In narrow gaps parts
/// of cells see each other by many.
bool are_rare(const Unfinished::Sampling& a, const Unfinished::Sampling& b, float range) {
  return !(a.is_part && b.is_part) && range * range > kRare * a.extent * b.extent;
}

}  // namespace

/// Lists how the next patches sample what they see, and the light that leaves them at first.
std::int64_t Field::list_samplings(Unfinished& work, std::int64_t rays) {
  const Solution& solution = work.solution;
  const std::size_t first = work.samplings.size();
  const std::size_t end = rows_from(first, solution.patches.size(), rays);
  for (std::size_t i = first; i < end; ++i) {
    const Patch& patch = surfaces_[solution.patches[i]];
    const double count = static_cast<double>(links(solution.patches[i]).size());
    work.samplings.push_back({static_cast<float>(count / patch.area),
                              static_cast<float>(std::sqrt(count * patch.area)), patch.is_part()});
    work.albedos.push_back(albedo_of(solution.patches[i]));
    work.leaving[i] = work.albedos[i] * (solution.direct[i] + solution.reflected[i]);
  }
  return 1 + static_cast<std::int64_t>(end - first) / kRowsPerRay;
}

/// Lists the rare links of the next patches by the patches that they hit.
std::int64_t Field::list_arrivals(Unfinished& work, std::int64_t rays) {
  const std::vector<std::uint32_t>& patches = work.solution.patches;
  const std::size_t first = work.arrived;
  const std::size_t end = rows_from(first, patches.size(), rays / kBouncesToList);
  work.last_arrivals.resize(patches.size(), kNoPatch);
  for (std::size_t i = first; i < end; ++i) {
    for (const Link& link : links(patches[i])) {
      const std::uint32_t to = work.place_of(link.patch);
      if (to == kNoPatch || !are_rare(work.samplings[i], work.samplings[to], link.range)) continue;
      const auto number = static_cast<std::uint32_t>(work.arrivals.size());
      work.arrivals.push_back(
          {static_cast<std::uint32_t>(i), std::exchange(work.last_arrivals[to], number)});
    }
  }
  work.arrived = end;
  return 1 + static_cast<std::int64_t>(end - first) * kBouncesToList / kRowsPerRay;
}

/// Lists the form factors of the next patches. As light goes both ways, links to a patch and those
/// back are samples of the same exchange, form factor times area, and rare ones count for both. Of
/// many links the evenly spread ones of one patch are more accurate.
std::int64_t Field::list_exchanges(Unfinished& work, std::int64_t rays) {
  const std::vector<std::uint32_t>& patches = work.solution.patches;
  if (work.rows.empty()) {
    work.rows.push_back(0);
    work.entries.resize(patches.size(), 0);
  }
  const std::size_t first = work.rows.size() - 1;
  const std::size_t end = rows_from(first, patches.size(), rays / kBouncesToMerge);
  for (std::size_t i = first; i < end; ++i) {
    const Unfinished::Sampling& own = work.samplings[i];
    const std::size_t begin = work.seen.size();
    float whole = 0.0F;
    const auto add = [&](std::uint32_t other, float exchange) {
      whole += exchange;
      if (other == kNoPatch) return;
      std::size_t& entry = work.entries[other];
      if (entry < begin || entry >= work.seen.size() || work.seen[entry] != other) {
        entry = work.seen.size();
        work.seen.push_back(other);
        work.factors.push_back(0.0F);
      }
      work.factors[entry] += exchange;
    };
    for (const Link& link : links(patches[i])) {
      const std::uint32_t to = work.place_of(link.patch);
      const bool rare = to != kNoPatch && are_rare(own, work.samplings[to], link.range);
      add(to, 1.0F / (rare ? own.density + work.samplings[to].density : own.density));
    }
    for (std::uint32_t k = work.last_arrivals[i]; k != kNoPatch; k = work.arrivals[k].before) {
      const std::uint32_t from = work.arrivals[k].from;
      add(from, 1.0F / (own.density + work.samplings[from].density));
    }
    for (std::size_t k = begin; k < work.seen.size(); ++k) work.factors[k] /= whole;
    work.rows.push_back(work.seen.size());
  }
  if (end == patches.size()) work.arrivals = {};
  return 1 + static_cast<std::int64_t>(end - first) * kBouncesToMerge / kRowsPerRay;
}

/// Continues a bounce: a Gauss-Seidel step of the radiosity equation for each patch.
std::int64_t Field::balance(Unfinished& work, std::int64_t rays) {
  Solution& solution = work.solution;
  const std::size_t first = work.balanced;
  const std::size_t end = rows_from(first, solution.patches.size(), rays);
  for (std::size_t i = first; i < end; ++i) {
    Rgb sum = Rgb::Zero();
    for (std::size_t k = work.rows[i]; k < work.rows[i + 1]; ++k) {
      sum += work.factors[k] * work.leaving[work.seen[k]];
    }
    work.change = std::max(work.change, (sum - solution.reflected[i]).abs().maxCoeff());
    work.total += solution.direct[i] + sum.maxCoeff();
    solution.reflected[i] = sum;
    work.leaving[i] = work.albedos[i] * (solution.direct[i] + sum);
  }
  work.balanced = end;
  return 1 + static_cast<std::int64_t>(end - first) / kRowsPerRay;
}

}  // namespace angen::light
