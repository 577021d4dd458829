#include "light/lighting.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "light/field.h"
#include "light/gather.h"

namespace angen::light {
namespace {

// Half of the color range: about what a white wall returns at 200 lx.
constexpr float kMiddleLuminance = 50.0F;  // cd/m^2
constexpr std::size_t kRaysAtOnce = 6000;  // some 10 ms

/// A probe that outlives a Lighting (a world that was reset) knows nothing about the next one.
std::uint64_t first_revision() {
  static std::atomic<std::uint64_t> made{0};
  return made++ << 32;
}

const Transport* known(const Probe& probe, LampId lamp, const Solution* solution) {
  if (solution == nullptr) return nullptr;
  const auto found = std::find_if(
      probe.transports.begin(), probe.transports.end(),
      [&](const Transport& t) { return t.lamp == lamp && t.solution == solution->stamp; });
  return found == probe.transports.end() ? nullptr : &*found;
}

}  // namespace

Lighting::Lighting(const rays::Scene& scene)
    : scene_(scene), field_(std::make_unique<Field>(scene)), lamps_revision_(first_revision()) {}

Lighting::~Lighting() = default;

void Lighting::count(double before, double after) {
  if (before > 0.0) --lit_count_;
  if (after > 0.0) ++lit_count_;
  if (before > 0.0 || after > 0.0) ++lit_revision_;
}

LampId Lighting::add(const Lamp& lamp, double level) {
  ++lamps_revision_;
  count(0.0, level);
  return lamps_.add({lamp, level, nullptr});
}

void Lighting::remove(LampId lamp) {
  count(level(lamp), 0.0);
  lamps_.remove(lamp);
  ++lamps_revision_;
}

void Lighting::set_level(LampId lamp, double level) {
  double& now = lamps_.at(lamp).level;
  if (now == level) return;
  count(now, level);
  now = level;
}

double Lighting::level(LampId lamp) const { return lamps_.at(lamp).level; }

void Lighting::move(LampId lamp, const Pose& pose) {
  Entry& entry = lamps_.at(lamp);
  if (entry.lamp.pose == pose) return;
  entry.lamp.pose = pose;
  entry.solution.reset();
  if (worked_on_ == lamp) work_.reset();
  ++lamps_revision_;
  count(entry.level, entry.level);
}

std::vector<Lit> Lighting::lit() const {
  std::vector<Lit> all;
  lamps_.each([&](LampId, const Entry& entry) {
    if (entry.level > 0.0) all.push_back({entry.lamp, entry.level});
  });
  return all;
}

/// Drops what lamps' light did where walls or doors have moved since.
void Lighting::follow() const {
  std::vector<Eigen::AlignedBox3d> touched;
  const bool same = field_->follow(touched);
  if (same && touched.empty()) return;
  work_.reset();  // of patches that may be others now
  lamps_.each([&](LampId, Entry& entry) {
    const auto meets = [&](const Eigen::AlignedBox3d& box) {
      return entry.solution->bounds.intersects(box);
    };
    if (entry.solution == nullptr) return;
    if (!same || std::any_of(touched.begin(), touched.end(), meets)) entry.solution.reset();
  });
}

/// The first lit lamp without a solution.
std::optional<LampId> Lighting::missing() const {
  std::optional<LampId> first;
  lamps_.each([&](LampId id, const Entry& entry) {
    if (!first && entry.level > 0.0 && entry.solution == nullptr) first = id;
  });
  return first;
}

void Lighting::prepare() {
  follow();
  busy_ = missing().has_value();
}

void Lighting::advance() {
  if (!busy_) return;
  follow();
  const std::optional<LampId> lamp = missing();
  busy_ = lamp.has_value();
  if (!busy_) {
    work_.reset();  // somebody has measured in the meantime
    return;
  }
  Entry& entry = lamps_.at(*lamp);
  if (work_ == nullptr || worked_on_ != *lamp) {
    work_ = std::make_unique<Unfinished>(entry.lamp);
    worked_on_ = *lamp;
  }
  if (!field_->advance(*work_, kRaysAtOnce)) return;
  entry.solution = std::make_shared<const Solution>(std::move(work_->solution));
  work_.reset();
}

/// Forgets what no longer holds.
void Lighting::renew(Probe& probe, const Pose& pose, bool still) const {
  const bool here = probe.pose == pose && probe.lamps_revision >> 32 == lamps_revision_ >> 32;
  const bool as_before = here && probe.revision == scene_.revision();
  if (as_before && probe.lamps_revision == lamps_revision_) return;
  const bool stands = here && probe.static_revision == scene_.static_revision();
  probe.pose = pose;
  probe.revision = scene_.revision();
  probe.static_revision = scene_.static_revision();
  probe.lamps_revision = lamps_revision_;
  if (!stands) probe.gather = nullptr;
  if (probe.gather) probe.gather->forget([&](LampId id) { return !lamps_.contains(id); });
  if (stands && (still || as_before)) return;
  probe.transports.clear();
  probe.reach = Eigen::AlignedBox3d(pose.position);
  if (probe.gather) probe.gather->forget_movers();
}

Sample Lighting::measure(Probe& probe, const Pose& pose, bool still) const {
  follow();
  renew(probe, pose, still);
  // A dark lamp's transport is left for when it is lit; each lamp's is independent of the others'.
  double illuminance = 0.0;
  Eigen::Array3f radiance = Eigen::Array3f::Zero();
  lamps_.each([&](LampId id, Entry& entry) {
    if (!(entry.level > 0.0)) return;
    const Transport* sent = known(probe, id, entry.solution.get());
    if (sent == nullptr) sent = &find(probe, id, entry);
    illuminance += entry.level * sent->illuminance;
    radiance += static_cast<float>(entry.level) * sent->radiance.array();
  });
  return {illuminance, (radiance / (radiance + kMiddleLuminance)).matrix()};
}

/// Of a lamp whose light comes to nothing that the place sees, only what comes straight counts.
const Transport& Lighting::find(Probe& probe, LampId id, Entry& entry) const {
  if (probe.gather == nullptr) {
    probe.gather = std::make_shared<Gather>(scene_, *field_, probe.pose);
  }
  if (entry.solution == nullptr) {
    entry.solution = std::make_shared<const Solution>(field_->solve(entry.lamp));
  }
  const Solution& solution = *entry.solution;
  Gathered gathered;
  if (probe.gather->may_see(solution.bounds)) {
    gathered = probe.gather->gather(id, entry.lamp, solution, probe.reach);
  }
  auto& all = probe.transports;
  all.erase(
      std::remove_if(all.begin(), all.end(), [&](const Transport& t) { return t.lamp == id; }),
      all.end());
  all.push_back(transport(scene_, probe.pose, entry.lamp, gathered, probe.reach));
  all.back().lamp = id;
  all.back().solution = solution.stamp;
  return all.back();
}

}  // namespace angen::light
