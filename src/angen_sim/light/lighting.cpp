#include "light/lighting.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "light/field.h"
#include "light/gather.h"

namespace angen::light {
namespace {

// Half of the color range: about what a white wall returns at 200 lx.
constexpr float kMiddleLuminance = 50.0F;   // cd/m^2
constexpr std::size_t kRaysAtOnce = 15000;  // some 5 ms
constexpr int kDeliveriesAtOnce = 3;
constexpr Nanoseconds kRest = kSecond / 10;  // changes are taken up when there was none for so long
constexpr Nanoseconds kLongestWait = kSecond;
constexpr std::size_t kMostWalls = 64;
constexpr std::size_t kMostGathers = 256;  // without a look at which are left

/// A probe that outlives a Lighting (a world that was reset) knows nothing about the next one.
std::uint64_t first_revision() {
  static std::atomic<std::uint64_t> made{0};
  return made++ << 32;
}

const Transport* known(const Probe& probe, LampId lamp, const Solution& solution) {
  const auto found = std::find_if(
      probe.transports.begin(), probe.transports.end(),
      [&](const Transport& t) { return t.lamp == lamp && t.solution == solution.stamp; });
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
  busy_ = true;
  return lamps_.add({lamp, level, nullptr});
}

void Lighting::remove(LampId lamp) {
  count(level(lamp), 0.0);
  lamps_.remove(lamp);
  ++lamps_revision_;
  if (worked_on_ == lamp) work_.reset();
}

void Lighting::set_level(LampId lamp, double level) {
  Entry& entry = lamps_.at(lamp);
  if (entry.level == level) return;
  count(entry.level, level);
  entry.level = level;
  busy_ = busy_ || entry.due || entry.solution == nullptr;
}

double Lighting::level(LampId lamp) const { return lamps_.at(lamp).level; }

void Lighting::move(LampId lamp, const Pose& pose) {
  Entry& entry = lamps_.at(lamp);
  if (entry.lamp.pose == pose) return;
  entry.lamp.pose = pose;
  entry.stale = true;
  ++entry.geometry;
  changed_ = busy_ = true;
  work_moved_ = work_moved_ || worked_on_ == lamp;
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

/// Finds what the light of lamps depends on and has changed. Whether anything has.
bool Lighting::follow() const {
  const std::vector<Field::Change> changes = field_->follow();
  if (changes.empty()) return false;
  changed_ = busy_ = true;
  for (const Field::Change& change : changes) {
    if (work_) work_changes_.push_back(change.box);
  }
  lamps_.each([&](LampId, Entry& entry) {
    if (entry.solution == nullptr) return;
    for (const Field::Change& change : changes) {
      if (!entry.solution->bounds.intersects(change.box)) continue;
      entry.stale = true;
      if (change.is_static) ++entry.geometry;
    }
  });
  for (const Field::Change& change : changes) {
    if (!change.is_static) continue;
    if (walls_.size() == kMostWalls) walls_.erase(walls_.begin());
    walls_.push_back(change.box);
    ++walls_count_;
  }
  return true;
}

/// Finds all at once.
void Lighting::complete() const {
  follow();
  if (field_->outdated() && !field_->updating()) field_->start_update();
  while (field_->updating()) {
    field_->update(SIZE_MAX);
    if (!field_->updating() && field_->outdated()) field_->start_update();
  }
  work_.reset();
  lamps_.each([&](LampId, Entry& entry) {
    if (!(entry.level > 0.0) || (entry.solution && !entry.stale)) return;
    entry.solution = std::make_shared<const Solution>(field_->solve(entry.lamp));
    entry.stale = entry.due = false;
  });
  changed_ = false;
}

void Lighting::pace() {
  if (paced_) return;
  complete();
  active_ = paced_ = true;
}

void Lighting::prepare() {
  if (!active_) busy_ = true;
  active_ = true;
}

void Lighting::note(Nanoseconds now) {
  if (!changed_) return;
  changed_ = false;
  if (!waiting_) first_change_ = now;
  last_change_ = now;
  waiting_ = true;
}

bool Lighting::missing() const {
  bool any = false;
  lamps_.each([&](LampId, const Entry& entry) {
    any = any || (entry.level > 0.0 && entry.solution == nullptr);
  });
  return any;
}

/// Whether what has changed is to be taken up now: for a new lamp at once, else when all lamps are
/// done that were due before.
bool Lighting::due(Nanoseconds now) const {
  if (!waiting_) return false;
  if (missing()) return true;
  if (next()) return false;
  const bool went_back = now < last_change_;
  return went_back || now - last_change_ >= kRest || now - first_change_ >= kLongestWait;
}

void Lighting::take_up() {
  waiting_ = false;
  if (field_->outdated()) field_->start_update();
  lamps_.each([](LampId, Entry& entry) { entry.due = entry.due || entry.stale; });
}

/// The lit lamp whose solution is found next: first those that have none.
std::optional<LampId> Lighting::next() const {
  std::optional<LampId> first, renewed;
  lamps_.each([&](LampId id, const Entry& entry) {
    if (!(entry.level > 0.0)) return;
    if (!first && entry.solution == nullptr) first = id;
    if (!renewed && entry.due) renewed = id;
  });
  return first ? first : renewed;
}

void Lighting::pick() {
  const std::optional<LampId> lamp = next();
  if (!lamp) return;
  Entry& entry = lamps_.at(*lamp);
  work_ = std::make_unique<Unfinished>(entry.lamp);
  worked_on_ = *lamp;
  work_changes_.clear();
  work_moved_ = false;
}

void Lighting::advance(Nanoseconds now) {
  follow();
  note(now);
  deliver();
  if (work_ && !(lamps_.at(worked_on_).level > 0.0)) work_.reset();
  if (!work_ && !field_->updating() && due(now)) take_up();
  std::size_t left = kRaysAtOnce;
  if (field_->updating()) {
    left -= std::min(left, field_->update(left));
    if (!dark()) ++lit_revision_;
  }
  if (!field_->updating() && left > 0) {
    if (!work_) pick();
    if (work_ && field_->advance(*work_, left)) publish();
  }
  busy_ = work_ || field_->updating() || waiting_ || !deliveries_.empty() || next();
}

void Lighting::publish() {
  Entry& entry = lamps_.at(worked_on_);
  entry.solution = std::make_shared<const Solution>(std::move(work_->solution));
  const Eigen::AlignedBox3d& bounds = entry.solution->bounds;
  entry.stale = work_moved_ || std::any_of(work_changes_.begin(), work_changes_.end(),
                                           [&](const auto& box) { return bounds.intersects(box); });
  entry.due = false;
  ++lit_revision_;
  work_.reset();
  for (const std::weak_ptr<Gather>& gather : gathers_) deliveries_.push_back({gather, worked_on_});
}

/// Does ahead of measure() what depends on neither what moves nor when.
void Lighting::deliver() {
  for (int i = 0; i < kDeliveriesAtOnce && !deliveries_.empty(); ++i) {
    const Delivery delivery = deliveries_.front();
    deliveries_.pop_front();
    const std::shared_ptr<Gather> gather = delivery.gather.lock();
    if (!gather || !lamps_.contains(delivery.lamp)) continue;
    const Entry& entry = lamps_.at(delivery.lamp);
    if (!entry.solution || !gather->may_see(entry.solution->bounds)) continue;
    gather->prepare(delivery.lamp, entry.lamp, entry.geometry);
  }
}

bool Lighting::walls_changed(const Probe& probe) const {
  const std::uint64_t count = walls_count_ - probe.walls;
  if (count > walls_.size()) return true;
  return std::any_of(walls_.end() - static_cast<std::ptrdiff_t>(count), walls_.end(),
                     [&](const Eigen::AlignedBox3d& box) {
                       return probe.reach.intersects(box) ||
                              (probe.gather && probe.gather->may_see(box));
                     });
}

std::shared_ptr<Gather> Lighting::make_gather(const Pose& pose) const {
  const auto expired = [](const std::weak_ptr<Gather>& gather) { return gather.expired(); };
  if (gathers_.size() >= kMostGathers) {
    gathers_.erase(std::remove_if(gathers_.begin(), gathers_.end(), expired), gathers_.end());
  }
  const auto made = std::make_shared<Gather>(scene_, *field_, pose);
  gathers_.push_back(made);
  return made;
}

/// Forgets what no longer holds.
void Lighting::renew(Probe& probe, const Pose& pose, bool still) const {
  const bool first = !knows(probe);
  const bool here = !first && probe.pose == pose;
  const bool as_before = here && probe.revision == scene_.revision();
  if (as_before && probe.lamps_revision == lamps_revision_) return;
  const bool stands = here && !walls_changed(probe);
  probe.pose = pose;
  probe.revision = scene_.revision();
  probe.walls = walls_count_;
  probe.lamps_revision = lamps_revision_;
  if (!stands) probe.gather = nullptr;
  if (probe.gather) probe.gather->forget([&](LampId id) { return !lamps_.contains(id); });
  if (first) probe.gather = make_gather(pose);  // while a world is loaded, not when a lamp is lit
  if (stands && (still || as_before)) return;
  probe.transports.clear();
  probe.reach = Eigen::AlignedBox3d(pose.position);
  if (probe.gather) probe.gather->forget_movers();
}

Sample Lighting::measure(Probe& probe, const Pose& pose, bool still) const {
  if (paced_) {
    follow();
  } else {
    complete();
  }
  renew(probe, pose, still);
  // A dark lamp's transport is left for when it is lit; each lamp's is independent of the others'.
  double illuminance = 0.0;
  Eigen::Array3f radiance = Eigen::Array3f::Zero();
  lamps_.each([&](LampId id, Entry& entry) {
    if (!(entry.level > 0.0) || entry.solution == nullptr) return;
    const Transport* sent = entry.stale ? nullptr : known(probe, id, *entry.solution);
    if (sent == nullptr) sent = &find(probe, id, entry);
    illuminance += entry.level * sent->illuminance;
    radiance += static_cast<float>(entry.level) * sent->radiance.array();
  });
  return {illuminance, (radiance / (radiance + kMiddleLuminance)).matrix()};
}

/// Of a lamp whose light comes to nothing that the place sees, only what comes straight counts.
const Transport& Lighting::find(Probe& probe, LampId id, Entry& entry) const {
  if (probe.gather == nullptr) probe.gather = make_gather(probe.pose);
  const Solution& solution = *entry.solution;
  Gathered gathered;
  if (probe.gather->may_see(solution.bounds)) {
    gathered =
        probe.gather->gather({id, entry.lamp, solution, entry.geometry, !entry.stale}, probe.reach);
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
