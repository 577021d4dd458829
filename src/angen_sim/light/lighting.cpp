#include "light/lighting.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "light/field.h"
#include "light/receiver.h"

namespace angen::light {
namespace {

constexpr std::int64_t kRaysAtOnce = 5000;  // about 1.5 ms
// At about 4,000 and 5,000 rays per ms, these are two thirds and a quarter of simulated time; the
// kept rays process small changes quickly.
constexpr Nanoseconds kPerSolvingRay = 400, kPerDeliveryRay = 800;
constexpr std::int64_t kKeptRays = 500000, kKeptDeliveryRays = 200000;
constexpr Nanoseconds kRest = kSecond / 10;  // changes are processed after this time without one
constexpr Nanoseconds kLongestWait = kSecond;
constexpr Nanoseconds kDarkFollow = kRest / 10;  // period of checks for changes in the dark

/// Whether a lamp has no complete solution, not even a stale one.
bool is_new(const std::shared_ptr<const Solution>& solution) {
  return solution == nullptr || solution->outlined;
}

/// Unique: a probe that outlives its Lighting (reset of the world) is unknown to the next one.
std::uint64_t next_id() {
  static std::atomic<std::uint64_t> made{0};
  return made++;
}

}  // namespace

Lighting::Lighting(const rays::Scene& scene)
    : scene_(scene),
      field_(std::make_unique<Field>(scene)),
      solving_(kPerSolvingRay, kKeptRays),
      delivering_(kPerDeliveryRay, kKeptDeliveryRays),
      id_(next_id()) {}

Lighting::~Lighting() = default;

void Lighting::count(double before, double after) {
  if (before > 0.0) --lit_count_;
  if (after > 0.0) ++lit_count_;
  if (before > 0.0 || after > 0.0) note_solved();
}

void Lighting::note_solved() {
  ++lit_revision_;
  ++solved_revision_;
}

LampId Lighting::add(const Lamp& lamp, double level) {
  count(0.0, level);
  busy_ = true;
  return lamps_.add({lamp, level, nullptr});
}

void Lighting::remove(LampId lamp) {
  count(level(lamp), 0.0);
  lamps_.remove(lamp);
  if (worked_on_ == lamp) work_.reset();
  for (const std::weak_ptr<Receiver>& each : receivers_) {
    const std::shared_ptr<Receiver> receiver = each.lock();
    if (receiver && receiver->gather) receiver->gather->forget(lamp);
  }
}

void Lighting::set_level(LampId lamp, double level) {
  Entry& entry = lamps_.at(lamp);
  if (entry.level == level) return;
  count(entry.level, level);
  if (!(entry.level > 0.0) && level > 0.0 && entry.solution) queue_all(lamp);
  entry.level = level;
  busy_ = busy_ || entry.due || is_new(entry.solution);
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
  count(entry.level, entry.level);
}

std::vector<Lit> Lighting::lit() const {
  std::vector<Lit> all;
  lamps_.each([&](LampId, const Entry& entry) {
    if (entry.level > 0.0) all.push_back({entry.lamp, entry.level});
  });
  return all;
}

std::shared_ptr<const ReflectedLight> Lighting::reflected() const {
  // New patches have none: they are in no solution.
  const std::pair now(solved_revision_, field_->forgotten());
  if (reflected_ && reflected_revision_ == now) return reflected_;
  std::vector<Rgb> light;
  lamps_.each([&](LampId, const Entry& entry) {
    if (!(entry.level > 0.0) || !entry.solution) return;
    Rgb factor = Rgb::Zero();
    factor.head<3>() = static_cast<float>(entry.level) * entry.lamp.color.array();
    field_->add_reflected(*entry.solution, factor, light);
  });
  reflected_ = std::make_shared<const ReflectedLight>(field_->pieces(light));
  reflected_revision_ = now;
  return reflected_;
}

/// Marks the lamps and places that changed shapes affect. Returns whether any shape has changed.
bool Lighting::follow() const {
  const std::vector<Field::Change> changes = field_->follow();
  if (changes.empty()) return false;
  changed_ = busy_ = true;
  lamps_.each([&](LampId, Entry& entry) {
    if (entry.solution == nullptr) return;
    for (const Field::Change& change : changes) {
      if (!entry.solution->bounds.intersects(change.box)) continue;
      entry.stale = true;
      if (change.is_static) ++entry.geometry;
    }
  });
  for (const Field::Change& change : changes) {
    if (change.is_static) drop_near(change.box);
  }
  return true;
}

/// Computes all light at once, unless that costs more than about `rays` rays. Returns whether it is
/// complete.
bool Lighting::complete(std::int64_t rays) const {
  follow();
  if (field_->outdated() && !field_->updating()) field_->start_update();
  while (field_->updating() && rays > 0) {
    rays -= field_->update(rays);
    if (!field_->updating() && field_->outdated()) field_->start_update();
  }
  work_.reset();
  if (field_->updating()) return false;
  bool all = true;
  lamps_.each([&](LampId, Entry& entry) {
    if (!(entry.level > 0.0) || (entry.solution && !entry.stale)) return;
    Unfinished work(entry.lamp);
    all = all && rays > 0 && field_->advance(work, rays);
    if (!all) return;
    entry.solution = std::make_shared<const Solution>(std::move(work.solution));
    entry.stale = entry.due = false;
  });
  if (all) changed_ = false;
  return all;
}

void Lighting::pace(std::int64_t rays) {
  if (paced_) return;
  active_ = paced_ = true;
  if (complete(rays)) {
    budget_ = SIZE_MAX;  // this tick is a part of loading
  } else {
    std::int64_t left = INT64_MAX;
    outline_new(left);
  }
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
    any = any || (entry.level > 0.0 && is_new(entry.solution));
  });
  return any;
}

/// Whether to process changes now: at once for a new lamp, else when the lamps are solved that were
/// due before.
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

/// The lit lamp to solve next: first new ones, then the others in turn.
std::optional<LampId> Lighting::next() const {
  std::optional<LampId> first, later, renewed;
  lamps_.each([&](LampId id, const Entry& entry) {
    if (!(entry.level > 0.0)) return;
    if (!first && is_new(entry.solution)) first = id;
    if (!entry.due) return;
    if (!renewed) renewed = id;
    if (!later && id.index > worked_on_.index) later = id;
  });
  return first ? first : later ? later : renewed;
}

void Lighting::pick() {
  const std::optional<LampId> lamp = next();
  if (!lamp) return;
  Entry& entry = lamps_.at(*lamp);
  work_ = std::make_unique<Unfinished>(entry.lamp);
  worked_on_ = *lamp;
  work_moved_ = false;
}

/// While no lamp is lit, changes can wait.
bool Lighting::may_wait(Nanoseconds now) const {
  const bool idle = dark() && !work_ && !field_->updating() && deliveries_.empty();
  return idle && now >= followed_ && now - followed_ < kDarkFollow;
}

void Lighting::advance(Nanoseconds now) {
  if (may_wait(now)) {
    busy_ = true;
    return;
  }
  followed_ = now;
  follow();
  note(now);
  solving_.pass_to(now);
  delivering_.pass_to(now);
  if (work_ && !(lamps_.at(worked_on_).level > 0.0)) work_.reset();
  if (!work_ && !field_->updating() && due(now)) take_up();
  const std::int64_t allowed = std::min(kRaysAtOnce, solving_.left());
  std::int64_t left = allowed;
  outline_new(left);
  if (left > 0 && field_->updating()) update(left);
  if (left > 0 && !field_->updating()) solve_on(left);
  solving_.spend(allowed - left);
  deliver();
  busy_ = work_ || field_->updating() || waiting_ || !deliveries_.empty() || next();
}

/// Gives lamps that are lit for the first time a rough solution at once: direct light and one
/// reflection.
void Lighting::outline_new(std::int64_t& left) {
  lamps_.each([&](LampId id, Entry& entry) {
    if (left <= 0 || !(entry.level > 0.0) || entry.solution) return;
    entry.solution = std::make_shared<const Solution>(field_->outline(entry.lamp, left));
    entry.stale = true;
    note_solved();
    queue_all(id);
  });
}

void Lighting::solve_on(std::int64_t& left) {
  if (!work_) pick();
  if (work_ && field_->advance(*work_, left)) publish();
}

void Lighting::update(std::int64_t& left) {
  left -= field_->update(left);
  if (!dark()) ++lit_revision_;
  if (field_->updating()) return;
  lamps_.each([&](LampId id, const Entry& entry) {
    if (entry.level > 0.0 && entry.solution && !entry.stale) queue_all(id);
  });
}

void Lighting::publish() {
  Entry& entry = lamps_.at(worked_on_);
  entry.solution = std::make_shared<const Solution>(std::move(work_->solution));
  entry.stale = work_moved_ || field_->outdated_in(entry.solution->bounds);
  entry.due = false;
  note_solved();
  work_.reset();
  queue_all(worked_on_);
}

}  // namespace angen::light
