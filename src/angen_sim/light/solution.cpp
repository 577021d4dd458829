#include "light/solution.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <numeric>
#include <thread>
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
constexpr double kBeside = 1e-2;      // m: beside a shadow ray
constexpr double kSettled = 1e-4;     // share of the mean: a change that ends the bounces
constexpr int kMaxBounces = 200;
constexpr std::size_t kThreads = 8;

double reach_of(const Lamp& lamp) {
  return kReach * std::max(1.0, std::sqrt(lamp.luminous_flux / 800.0));
}

std::uint64_t next_stamp() {
  static std::atomic<std::uint64_t> stamps{0};
  return ++stamps;
}

std::uint32_t place_in(const Field& field, const Solution& solution, std::uint32_t patch) {
  const std::uint32_t number = patch - solution.first_patch;  // wraps around below the first
  if (number >= solution.places.size()) return kNoPatch;
  const std::uint32_t at = solution.places[number];
  return at != kNoPatch && field.holds(patch, solution.serials[at]) ? at : kNoPatch;
}

class Solver {
 public:
  /// All ends soon, with nothing of use, once `stop` is set.
  Solver(const Unsolved& of, Field& field, const std::atomic<bool>& stop)
      : of_(of),
        lamp_(of.lamp),
        field_(field),
        stop_(stop),
        world_(field.scene().static_bounds()) {}

  /// Adds patches and links to the field.
  void find_patches() {
    light_first();
    for (std::size_t i = 0; i < out_.patches.size() && !stop_; ++i) follow(i);
  }

  /// After find_patches(); reads the field only.
  Solution solve() {
    if (stop_) return {};
    list_arrivals();
    list_exchanges();
    for (int i = 0; i < kMaxBounces && !out_.patches.empty() && !stop_ && bounce(); ++i) {
    }
    finish();
    return std::move(out_);
  }

 private:
  struct Arrival {  // a link to a patch that counts as one from it
    std::uint32_t from = 0;
    float exchange = 0.0F;  // m^2
  };

  std::uint32_t place_of(std::uint32_t patch) const {
    return patch < places_.size() ? places_[patch] : kNoPatch;
  }

  /// Adds a patch to the solution, unless it contains the patch.
  void reach(std::uint32_t patch) {
    if (patch == kNoPatch || place_of(patch) != kNoPatch) return;
    if (places_.size() <= patch) places_.resize(patch + 1 + patch / 2, kNoPatch);
    places_[patch] = static_cast<std::uint32_t>(out_.patches.size());
    out_.patches.push_back(patch);
  }

  /// Finds the directly lit patches.
  void light_first() {
    const std::vector<rays::Ray> rays = first_rays(lamp_, world_);
    std::vector<rays::Hit> hits(rays.size());
    field_.scene().cast(rays.data(), hits.data(), rays.size(), kStanding);
    for (std::size_t i = 0; i < rays.size() && !stop_; ++i) {
      reach(field_.link_of(rays[i], hits[i]).patch);
    }
  }

  bool is_near(std::uint32_t patch) const {
    const Vec3& at = field_[patch].sites.front().position;
    return lamp_.type == Lamp::Type::kDirectional
               ? world_.squaredExteriorDistance(at) < kReach * kReach
               : (at - lamp_.pose.position).norm() < reach_of(lamp_);
  }

  /// Whether no shape has moved between the patch and the lamp since the known solution.
  bool is_free(const Patch& on) const {
    if (lamp_.type == Lamp::Type::kDirectional) return false;
    Eigen::AlignedBox3d sites;
    for (const Site& site : on.sites) sites.extend(site.position);
    const double size = std::max(
        {lamp_.radius, std::hypot(lamp_.width, lamp_.height) / 2, lamp_.length / 2 + lamp_.radius});
    const Vec3 beside = Vec3::Constant(std::max(size, sites.diagonal().norm() / 2) + kBeside);
    rays::Ray ray;
    ray.origin = sites.center();
    const Vec3 way = lamp_.pose.position - ray.origin;
    ray.direction = way.normalized();
    return std::none_of(of_.moved.begin(), of_.moved.end(), [&](const auto& moved) {
      return passes({moved.box.min() - beside, moved.box.max() + beside}, ray, way.norm());
    });
  }

  float direct(std::uint32_t patch) const {
    const Patch& on = field_[patch];
    if (of_.known != nullptr) {
      const std::uint32_t before = place_in(field_, *of_.known, patch);
      if (before != kNoPatch && is_free(on)) return of_.known->direct[before];
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < on.sites.size(); ++i) {
      const Site& site = on.sites[i];
      const double lux = illuminance(lamp_, site.position, site.normal);
      if (lux > 0.0 && sees_one(field_.scene(), lamp_, site.position, site.normal,
                                i + on.hash % kLampPoints, kStanding)) {
        sum += lux;
      }
    }
    return static_cast<float>(sum / static_cast<double>(on.sites.size()));
  }

  /// Computes the light on a patch and follows it to other patches, within kReach and kDark. The
  /// first guess of reflected light is that of the patches before it.
  void follow(std::size_t i) {
    const std::uint32_t patch = out_.patches[i];
    const std::vector<Field::Link>& seen = field_.links(patch);
    links_.push_back(&seen);
    Rgb sum = Rgb::Zero();
    for (const Field::Link& link : seen) {
      const std::uint32_t place = place_of(link.patch);
      if (place < i) sum += leaving_[place];
    }
    out_.direct.push_back(direct(patch));
    out_.reflected.push_back(sum / static_cast<float>(seen.size()));
    albedos_.push_back(field_.albedo_of(patch));
    leaving_.push_back(albedos_[i] * (out_.direct[i] + out_.reflected[i]));
    if (leaving_[i].maxCoeff() < kDark) return;
    for (const Field::Link& link : seen) {
      if (link.patch != kNoPatch && is_near(link.patch)) reach(link.patch);
    }
  }

  /// Calls visit(from, to, link) for each rare link between patches of the solution.
  template <class F>
  void each_rare(F&& visit) const {
    for (std::uint32_t i = 0; i < out_.patches.size(); ++i) {
      for (const Field::Link& link : *links_[i]) {
        const std::uint32_t to = link.is_rare ? place_of(link.patch) : kNoPatch;
        if (to != kNoPatch) visit(i, to, link);
      }
    }
  }

  /// Lists the rare links by the patches that they hit.
  void list_arrivals() {
    first_arrivals_.assign(out_.patches.size() + 1, 0);
    each_rare(
        [&](std::uint32_t, std::uint32_t to, const Field::Link&) { ++first_arrivals_[to + 1]; });
    std::partial_sum(first_arrivals_.begin(), first_arrivals_.end(), first_arrivals_.begin());
    arrivals_.resize(first_arrivals_.back());
    std::vector<std::uint32_t> next = first_arrivals_;
    each_rare([&](std::uint32_t from, std::uint32_t to, const Field::Link& link) {
      arrivals_[next[to]++] = {from, link.exchange};
    });
  }

  /// Lists form factors.
  void list_exchanges() {
    std::vector<std::size_t> entries(out_.patches.size(), 0);  // in the last row that has a patch
    rows_.push_back(0);
    for (std::size_t i = 0; i < out_.patches.size(); ++i) {
      const std::size_t begin = seen_.size();
      float whole = 0.0F;
      const auto add = [&](std::uint32_t other, float exchange) {
        whole += exchange;
        if (other == kNoPatch) return;
        std::size_t& entry = entries[other];
        if (entry < begin || entry >= seen_.size() || seen_[entry] != other) {
          entry = seen_.size();
          seen_.push_back(other);
          factors_.push_back(0.0F);
        }
        factors_[entry] += exchange;
      };
      const Patch& patch = field_[out_.patches[i]];
      const float unseen =
          1.0F / static_cast<float>(static_cast<double>(links_of(patch)) / patch.area);
      for (const Field::Link& link : *links_[i]) {
        if (link.patch == kNoPatch && std::isfinite(link.range)) continue;  // a sliver
        const std::uint32_t to = place_of(link.patch);
        add(to, to == kNoPatch ? unseen : link.exchange);
      }
      for (std::uint32_t k = first_arrivals_[i + 1]; k-- > first_arrivals_[i];) {
        add(arrivals_[k].from, arrivals_[k].exchange);
      }
      for (std::size_t k = begin; k < seen_.size(); ++k) factors_[k] /= whole;
      rows_.push_back(seen_.size());
    }
  }

  /// A Gauss-Seidel step of the radiosity equation for each patch. False if nothing has changed.
  bool bounce() {
    float change = 0.0F;  // lx, the largest
    double total = 0.0;   // lx, sum over the patches
    for (std::size_t i = 0; i < out_.patches.size(); ++i) {
      Rgb sum = Rgb::Zero();
      for (std::size_t k = rows_[i]; k < rows_[i + 1]; ++k) sum += factors_[k] * leaving_[seen_[k]];
      change = std::max(change, (sum - out_.reflected[i]).abs().maxCoeff());
      total += out_.direct[i] + sum.maxCoeff();
      out_.reflected[i] = sum;
      leaving_[i] = albedos_[i] * (out_.direct[i] + sum);
    }
    return change > kSettled * (total / static_cast<double>(out_.patches.size()));
  }

  void finish() {
    if (lamp_.type != Lamp::Type::kDirectional) out_.bounds.extend(lamp_.pose.position);
    for (const std::uint32_t patch : out_.patches) {
      out_.serials.push_back(field_[patch].serial);
      for (const Site& site : field_[patch].sites) out_.bounds.extend(site.position);
    }
    // A patch extends beyond its outermost sites.
    out_.bounds.min().array() -= kBeyondSites;
    out_.bounds.max().array() += kBeyondSites;
    out_.stamp = next_stamp();
    if (out_.patches.empty()) return;
    const auto [low, high] = std::minmax_element(out_.patches.begin(), out_.patches.end());
    out_.first_patch = *low;
    out_.places.assign(places_.begin() + *low, places_.begin() + *high + 1);
    out_.patches.shrink_to_fit();
    out_.direct.shrink_to_fit();
    out_.reflected.shrink_to_fit();
  }

  const Unsolved of_;
  const Lamp& lamp_;
  Field& field_;
  const std::atomic<bool>& stop_;
  Eigen::AlignedBox3d world_;  // m, bounds of static shapes
  Solution out_;
  std::vector<std::uint32_t> places_;  // by patch: its index in the solution, or kNoPatch
  std::vector<Rgb> leaving_;           // lx, by index, as what follows
  std::vector<Rgb> albedos_;
  std::vector<const std::vector<Field::Link>*> links_;
  std::vector<std::uint32_t> first_arrivals_;  // at each patch, and the number of all
  std::vector<Arrival> arrivals_;              // by patch
  std::vector<std::size_t> rows_;              // begin of each patch's part of `seen_`, and the end
  std::vector<std::uint32_t> seen_;            // the patches that each one sees
  std::vector<float> factors_;                 // by entry of `seen_`: form factor
};

/// One more bounce, from the patches of the solution.
Rgb indirect_on(Field& field, const Solution& solution, std::uint32_t patch) {
  if (solution.indirect_revision != field.revision()) solution.indirect_cache.clear();
  solution.indirect_revision = field.revision();
  const auto [known, is_new] = solution.indirect_cache.try_emplace(patch, Rgb::Zero());
  if (!is_new) return known->second;
  Rgb sum = Rgb::Zero();
  const std::vector<Field::Link>& seen_from = field.links(patch);
  for (const Field::Link& link : seen_from) {
    if (link.patch == kNoPatch) continue;
    const std::uint32_t seen = place_in(field, solution, link.patch);
    if (seen == kNoPatch) continue;
    sum += field.albedo_of(link.patch) * (solution.direct[seen] + solution.reflected[seen]);
  }
  return known->second = sum / static_cast<float>(seen_from.size());
}

}  // namespace

std::vector<std::shared_ptr<const Solution>> solve(const std::vector<Unsolved>& lamps,
                                                   Field& field) {
  std::vector<Solver> solvers;
  solvers.reserve(lamps.size());
  const std::atomic<bool> stop{false};
  for (const Unsolved& each : lamps) solvers.emplace_back(each, field, stop).find_patches();
  std::vector<std::shared_ptr<const Solution>> solved(lamps.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < lamps.size(); i = next++) {
      solved[i] = std::make_shared<const Solution>(solvers[i].solve());
    }
  };
  std::vector<std::future<void>> others;
  const std::size_t threads = std::min<std::size_t>(std::thread::hardware_concurrency(), kThreads);
  for (std::size_t i = 1; i < std::min(threads, lamps.size()); ++i) {
    others.push_back(std::async(std::launch::async, work));
  }
  work();
  for (std::future<void>& other : others) other.get();
  return solved;
}

std::shared_ptr<const Solution> solve(const Lamp& lamp, Field& field,
                                      const std::atomic<bool>& stop) {
  const std::vector<Changes::Moved> none;
  Solver solver({lamp, nullptr, none}, field, stop);
  solver.find_patches();
  auto solved = std::make_shared<const Solution>(solver.solve());
  return stop ? nullptr : solved;
}

float direct_on(const Field& field, const Solution& solution, std::uint32_t patch) {
  const std::uint32_t at = place_in(field, solution, patch);
  return at == kNoPatch ? 0.0F : solution.direct[at];
}

Rgb reflected_on(Field& field, const Solution& solution, std::uint32_t patch, bool stale) {
  if (patch == kNoPatch) return Rgb::Zero();
  const std::uint32_t at = place_in(field, solution, patch);
  if (at != kNoPatch) return solution.reflected[at];
  const bool in_bounds = solution.bounds.contains(field[patch].sites.front().position);
  return stale || !in_bounds ? Rgb(Rgb::Zero()) : indirect_on(field, solution, patch);
}

void add_reflected(const Field& field, const Solution& solution, const Rgb& factor,
                   std::vector<Rgb>& light) {
  light.resize(field.size(), Rgb::Zero());
  for (std::size_t i = 0; i < solution.patches.size(); ++i) {
    const std::uint32_t patch = solution.patches[i];
    if (field.holds(patch, solution.serials[i])) light[patch] += factor * solution.reflected[i];
  }
}

}  // namespace angen::light
