#include "light/lighting.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <future>
#include <utility>

#include "core/lists.h"
#include "core/slots.h"
#include "light/balance.h"
#include "light/gather.h"

namespace angen::light {

/// Cache of a place of measurement: the surfaces around it, and the light of each lamp.
struct Receiver {
  static constexpr std::uint64_t kNever = UINT64_MAX;

  struct Known {
    LampId lamp;
    Transport transport;  // the newest one, if `found`
    bool found = false;
    std::uint64_t stamp = 0;       // stamp of its solution
    std::uint64_t geometry = 0;    // geometry of its source
    std::uint64_t scene = kNever;  // the scene's revision for which it is valid

    bool holds(const Source& source, std::uint64_t revision) const {
      return found && stamp == source.solution.stamp && geometry == source.geometry &&
             scene == revision;
    }
  };

  explicit Receiver(const Pose& at) : pose(at) {}

  Known& of(LampId lamp) {
    if (known.size() <= lamp.index) known.resize(lamp.index + 1);
    Known& found = known[lamp.index];
    if (found.lamp != lamp) {
      found = {};
      found.lamp = lamp;
    }
    return found;
  }
  /// The known light of the lamp, or null.
  const Known* find(LampId lamp) const {
    if (known.size() <= lamp.index || known[lamp.index].lamp != lamp) return nullptr;
    return known[lamp.index].found ? &known[lamp.index] : nullptr;
  }

  /// Keeps known light valid for that revision of the scene if its reach is in the box, where
  /// nothing has moved according to `still`.
  void note(std::uint64_t revision, bool still, const Eigen::AlignedBox3d& box) {
    for (Known& each : known) {
      if (each.scene == revision || each.scene == kNever) continue;
      each.scene = still && box.contains(each.transport.reach) ? revision : kNever;
    }
    if (gather && still) gather->hold_movers(box);
  }

  /// Forgets the surfaces around it; known light is used until it is computed again.
  void drop() {
    gather = nullptr;
    for (Known& each : known) each.scene = kNever;
  }
  /// Whether a change of static shapes in the box (m, world) affects it.
  bool intersects(const Eigen::AlignedBox3d& box) const {
    if (gather && gather->may_see(box)) return true;
    return std::any_of(known.begin(), known.end(), [&](const Known& each) {
      return each.found && each.transport.reach.intersects(box);
    });
  }

  Pose pose;
  std::unique_ptr<Gather> gather;
  std::vector<Known> known;  // by the lamp's index
};

namespace {

constexpr Nanoseconds kRest = kSecond / 10;   // changes are followed after this time without one
constexpr Nanoseconds kDelay = kSecond / 10;  // from then on until the light is taken over
constexpr Nanoseconds kLongestWait = 5 * kSecond;
// Half of the color range: about the luminance of a white wall at 200 lx.
constexpr float kMiddleLuminance = 50.0F;   // cd/m^2
constexpr std::size_t kMaxReceivers = 256;  // from this number on, expired ones are removed

/// Unique: a probe that outlives its Lighting (reset of the world) is unknown to the next one.
std::uint64_t next_id() {
  static std::atomic<std::uint64_t> made{0};
  return made++;
}

struct Entry {
  Lamp lamp;
  double level;
  std::shared_ptr<const Solution> solution;  // in the scene that was taken over last, or null
  std::uint64_t solved = 0;                  // the version for which it is
  std::uint64_t version = 0;                 // grows when the lamp is moved
  std::uint64_t geometry = 0;                // see Source
  bool switched_on = false;                  // since the last check
  bool asked = false;                        // the balance that was started last has its light
  bool shining = false;                      // measured: its light is known

  bool lit() const { return level > 0.0; }
};

/// A balance that another thread finds.
struct Pending {
  Nanoseconds due = 0;
  std::vector<LampId> lit;
  std::vector<Changes::Moved> moved;
  std::shared_future<std::shared_ptr<const Balance>> result;
};

}  // namespace

struct Lighting::Impl {
  explicit Impl(const rays::Scene& all) : scene(all) {}

  void count(double before, double after);
  void follow();
  bool is_outdated(const Entry& entry) const;
  void check_switched();
  Request request(std::vector<LampId>& lit);
  Balance base() const;
  void take(const Balance& balance, const std::vector<LampId>& lit);
  bool is_unbalanced() const;
  void balance_now();
  void start(Nanoseconds now);
  bool is_due(Nanoseconds now) const;
  std::vector<Request::Of> unforeseen() const;

  Receiver& receiver(Probe& probe, const Pose& pose);
  void drop_near(const Eigen::AlignedBox3d& box) const;
  void find(Receiver& receiver, const Source& source);

  const rays::Scene& scene;
  Slots<Entry, LampTag> lamps;
  Field field;
  Changes changes;
  std::shared_ptr<const rays::Scene> standing;     // the scene of the balance that was started last
  std::deque<Pending> pending;                     // in the order of their times
  std::vector<std::weak_ptr<Receiver>> receivers;  // receivers of all probes
  bool keeps_time = false;
  bool changed = false;          // shapes or lamps, since the last advance()
  bool switched = false;         // a lamp may have been switched on since the last check
  bool lacking = false;          // a lamp was switched on whose light among the shapes is unknown
  bool waiting = false;          // for changes to end
  Nanoseconds first_change = 0;  // first of the waiting changes
  Nanoseconds last_change = 0;   // last of the waiting changes
  std::uint64_t id = next_id();
  std::size_t lit_count = 0;
  std::shared_ptr<const ReflectedLight> reflected;  // null until it is queried
  // The lit_revision, and the patches forgotten before, of `reflected`.
  std::pair<std::uint64_t, std::uint64_t> reflected_revision{0, 0};
  std::uint64_t lit_revision = 0;
  std::vector<Solved> ahead;           // see Balance
  bool foreseen = false;               // unforeseen() was empty, and no lamp is new since
  std::unique_ptr<LookAhead> looking;  // from what is known, until the next balance is started
};

Lighting::Lighting(const rays::Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}

Lighting::~Lighting() = default;

bool Lighting::dark() const { return impl_->lit_count == 0; }
std::uint64_t Lighting::lit_revision() const { return impl_->lit_revision; }
bool Lighting::knows(const Probe& probe) const { return probe.lighting == impl_->id; }
bool Lighting::keeps_time() const { return impl_->keeps_time; }

void Lighting::Impl::count(double before, double after) {
  if (before > 0.0) --lit_count;
  if (after > 0.0) ++lit_count;
  if (before > 0.0 || after > 0.0) ++lit_revision;
}

LampId Lighting::add(const Lamp& lamp, double level) {
  impl_->count(0.0, level);
  Entry entry{lamp, level, nullptr};
  entry.switched_on = entry.lit();
  impl_->switched = impl_->switched || entry.lit();
  impl_->foreseen = false;
  return impl_->lamps.add(std::move(entry));
}

void Lighting::remove(LampId lamp) {
  impl_->count(level(lamp), 0.0);
  impl_->lamps.remove(lamp);
  for (const std::weak_ptr<Receiver>& each : impl_->receivers) {
    const std::shared_ptr<Receiver> receiver = each.lock();
    if (receiver && receiver->gather) receiver->gather->forget(lamp);
  }
}

void Lighting::set_level(LampId lamp, double level) {
  Entry& entry = impl_->lamps.at(lamp);
  if (entry.level == level) return;
  impl_->count(entry.level, level);
  if (!entry.lit()) entry.switched_on = impl_->switched = true;
  entry.level = level;
  if (!entry.lit()) entry.shining = false;
}

double Lighting::level(LampId lamp) const { return impl_->lamps.at(lamp).level; }

void Lighting::move(LampId lamp, const Pose& pose) {
  Entry& entry = impl_->lamps.at(lamp);
  if (entry.lamp.pose == pose) return;
  entry.lamp.pose = pose;
  impl_->changed = true;
  ++entry.version;
  ++entry.geometry;
  impl_->count(entry.level, entry.level);
}

std::vector<Lit> Lighting::lit() const {
  std::vector<Lit> all;
  impl_->lamps.each([&](LampId, const Entry& entry) {
    if (entry.lit()) all.push_back({entry.lamp, entry.level});
  });
  return all;
}

std::shared_ptr<const ReflectedLight> Lighting::reflected() const {
  // New patches have none: they are in no solution.
  const std::pair now(impl_->lit_revision, impl_->field.forgotten());
  if (impl_->reflected && impl_->reflected_revision == now) return impl_->reflected;
  std::vector<Rgb> light;
  impl_->lamps.each([&](LampId, const Entry& entry) {
    if (!entry.lit() || !entry.shining) return;
    Rgb factor = Rgb::Zero();
    factor.head<3>() = static_cast<float>(entry.level) * entry.lamp.color.array();
    add_reflected(impl_->field, *entry.solution, factor, light);
  });
  impl_->reflected = std::make_shared<const ReflectedLight>(impl_->field.pieces(light));
  impl_->reflected_revision = now;
  return impl_->reflected;
}

/// Notes the standing shapes that have changed.
void Lighting::Impl::follow() {
  for (const Changes::Change& change : changes.follow(scene)) {
    changed = true;
    if (!change.is_static) continue;
    drop_near(change.box);
    lamps.each([&](LampId, Entry& entry) {
      if (!entry.solution || entry.solution->bounds.intersects(change.box)) ++entry.geometry;
    });
  }
}

/// Whether the lamp or standing shapes in its light have changed since it was solved.
bool Lighting::Impl::is_outdated(const Entry& entry) const {
  const Eigen::AlignedBox3d& bounds = entry.solution->bounds;
  return entry.solved != entry.version || changes.any_in(bounds) ||
         std::any_of(pending.begin(), pending.end(),
                     [&](const Pending& each) { return any_in(bounds, each.moved); });
}

/// A lamp that was switched on shines at once if its light among the present shapes is known.
void Lighting::Impl::check_switched() {
  if (!std::exchange(switched, false)) return;
  lamps.each([&](LampId, Entry& entry) {
    if (!std::exchange(entry.switched_on, false) || !entry.lit()) return;
    entry.shining = entry.solution && !is_outdated(entry);
    lacking = lacking || (!entry.shining && (!entry.asked || changes.any()));
  });
}

/// Asks for the light of the present scene. Appends the lamps that will be known.
Request Lighting::Impl::request(std::vector<LampId>& lit) {
  waiting = changed = switched = lacking = false;
  lamps.each([&](LampId, Entry& entry) {
    entry.switched_on = false;
    entry.asked = entry.lit() || (entry.solution && !is_outdated(entry));
  });
  Request of;
  of.moved = changes.take();
  if (!of.moved.empty() || !standing) standing = scene.standing_scene();
  of.scene = standing;
  lamps.each([&](LampId lamp, Entry& entry) {
    of.lamps.push_back({lamp, entry.version, entry.lamp, entry.lit()});
    if (entry.lit()) lit.push_back(lamp);
  });
  return of;
}

Balance Lighting::Impl::base() const {
  Balance known{field, {}, ahead};
  lamps.each([&](LampId lamp, const Entry& entry) {
    if (entry.solution) known.solved.push_back({lamp, entry.solved, entry.solution});
  });
  return known;
}

void Lighting::Impl::take(const Balance& balance, const std::vector<LampId>& lit) {
  field = balance.field;
  ahead = balance.ahead;
  foreseen = false;
  ++lit_revision;
  lamps.each([](LampId, Entry& entry) { entry.solution = nullptr; });
  for (const Solved& each : balance.solved) {
    if (!lamps.contains(each.id)) continue;
    lamps.at(each.id).solution = each.solution;
    lamps.at(each.id).solved = each.version;
  }
  for (const LampId lamp : lit) {
    if (lamps.contains(lamp)) lamps.at(lamp).shining = lamps.at(lamp).lit();
  }
}

/// Whether the light of a lit lamp is not that of the present scene.
bool Lighting::Impl::is_unbalanced() const {
  bool any = changes.any();
  lamps.each([&](LampId, const Entry& entry) {
    any = any || (entry.lit() && (!entry.shining || entry.solved != entry.version));
  });
  return any;
}

void Lighting::Impl::balance_now() {
  std::vector<LampId> lit;
  const Request of = request(lit);
  take(balance(base(), of), lit);
}

void Lighting::Impl::start(Nanoseconds now) {
  Pending next;
  next.due = now + kDelay;
  Request of = request(next.lit);
  next.moved = of.moved;
  const auto shared = std::make_shared<const Request>(std::move(of));
  if (looking) {
    looking->stop();
    next.result = std::async(std::launch::async, [before = std::move(looking), shared] {
                    return std::make_shared<const Balance>(balance(before->take(), *shared));
                  }).share();
  } else if (pending.empty()) {
    next.result = std::async(std::launch::async, [before = base(), shared]() mutable {
                    return std::make_shared<const Balance>(balance(std::move(before), *shared));
                  }).share();
  } else {
    next.result = std::async(std::launch::async, [before = pending.back().result, shared] {
                    return std::make_shared<const Balance>(balance(*before.get(), *shared));
                  }).share();
  }
  pending.push_back(std::move(next));
}

/// The lamps without light, for which it was not looked for either.
std::vector<Request::Of> Lighting::Impl::unforeseen() const {
  std::vector<Request::Of> of;
  lamps.each([&](LampId lamp, const Entry& entry) {
    const auto is_of = [&](const Solved& each) { return each.id == lamp; };
    if (entry.solution || std::any_of(ahead.begin(), ahead.end(), is_of)) return;
    of.push_back({lamp, entry.version, entry.lamp, false});
  });
  return of;
}

bool Lighting::may_look_ahead() const {
  if (!impl_->keeps_time || impl_->foreseen || impl_->looking || !impl_->pending.empty()) {
    return false;
  }
  impl_->foreseen = impl_->unforeseen().empty();
  return !impl_->foreseen;
}

void Lighting::look_ahead() {
  Impl& own = *impl_;
  own.follow();
  Balance from = own.base();
  if (own.changes.any()) {
    if (!dark() || !from.solved.empty()) return;  // a balance will take them over
    std::vector<LampId> none;
    const Request of = own.request(none);
    own.field.update(of.scene, of.moved);
    from.field = own.field;
  }
  own.looking = std::make_unique<LookAhead>(std::move(from), own.unforeseen());
}

void Lighting::keep_time() {
  if (std::exchange(impl_->keeps_time, true)) return;
  impl_->follow();
  impl_->balance_now();
}

bool Lighting::Impl::is_due(Nanoseconds now) const {
  if (!waiting) return false;
  const bool went_back = now < last_change;
  return went_back || now - last_change >= kRest || now - first_change >= kLongestWait;
}

void Lighting::advance(Nanoseconds now) {
  std::deque<Pending>& pending = impl_->pending;
  while (!pending.empty() && (pending.front().due <= now || pending.front().due > now + kDelay)) {
    const Pending due = std::move(pending.front());
    pending.pop_front();
    impl_->take(*due.result.get(), due.lit);
  }
  if (dark()) return;
  impl_->follow();
  if (std::exchange(impl_->changed, false)) {
    if (!impl_->waiting) impl_->first_change = now;
    impl_->last_change = now;
    impl_->waiting = true;
  }
  impl_->check_switched();
  if (impl_->lacking || impl_->is_due(now)) impl_->start(now);
}

std::optional<Nanoseconds> Lighting::next() const {
  std::optional<Nanoseconds> due;
  if (!impl_->pending.empty()) due = impl_->pending.front().due;
  if (dark()) return due;
  if (impl_->switched || impl_->lacking || impl_->changed) return 0;
  if (!impl_->waiting) return due;
  const Nanoseconds rest = std::min(impl_->last_change + kRest, impl_->first_change + kLongestWait);
  return std::min(rest, due.value_or(rest));
}

Receiver& Lighting::Impl::receiver(Probe& probe, const Pose& pose) {
  if (probe.lighting != id) {
    probe.receiver = std::make_shared<Receiver>(pose);
    probe.lighting = id;
    probe.reach = Eigen::AlignedBox3d(pose.position);
    if (receivers.size() >= kMaxReceivers) {
      const auto expired = [](const std::weak_ptr<Receiver>& each) { return each.expired(); };
      erase_if(receivers, expired);
    }
    receivers.push_back(probe.receiver);
  }
  Receiver& receiver = *probe.receiver;
  if (receiver.pose == pose) return receiver;
  receiver.drop();
  receiver.pose = pose;
  return receiver;
}

/// Drops the surfaces of places that changes of static shapes in the box affect.
void Lighting::Impl::drop_near(const Eigen::AlignedBox3d& box) const {
  for (const std::weak_ptr<Receiver>& each : receivers) {
    const std::shared_ptr<Receiver> receiver = each.lock();
    if (receiver && receiver->intersects(box)) receiver->drop();
  }
}

/// A lamp that lights no surface in view of the place gives direct light only.
void Lighting::Impl::find(Receiver& receiver, const Source& source) {
  if (!receiver.gather) receiver.gather = std::make_unique<Gather>(scene, field, receiver.pose);
  Eigen::AlignedBox3d reach(receiver.pose.position);
  Gathered gathered;
  if (receiver.gather->may_see(source.solution.bounds)) {
    gathered = receiver.gather->gather(source, reach);
  }
  Receiver::Known& known = receiver.of(source.id);
  known.transport = transport(scene, receiver.pose, source.lamp, gathered, reach);
  known.found = true;
  known.stamp = source.solution.stamp;
  known.geometry = source.geometry;
  known.scene = scene.revision();
}

Sample Lighting::measure(Probe& probe, const Pose& pose, bool still) const {
  Impl& own = *impl_;
  own.follow();
  if (own.keeps_time) {
    own.check_switched();
  } else if (own.is_unbalanced()) {
    own.balance_now();
  }
  Receiver& place = own.receiver(probe, pose);
  const std::uint64_t revision = own.scene.revision();
  place.note(revision, still, probe.reach);
  probe.reach = Eigen::AlignedBox3d(pose.position);
  // A dark lamp's transport is computed when it is lit; lamps are independent of each other.
  double illuminance = 0.0;
  Eigen::Array3f radiance = Eigen::Array3f::Zero();
  own.lamps.each([&](LampId id, const Entry& entry) {
    const bool lit = entry.lit() && entry.shining;
    if (lit) {
      const Source from{id, entry.lamp, *entry.solution, entry.geometry, own.is_outdated(entry)};
      if (!place.of(id).holds(from, revision)) own.find(place, from);
    }
    const Receiver::Known* known = place.find(id);
    if (known == nullptr || (!lit && known->scene != revision)) return;
    probe.reach.extend(known->transport.reach);
    if (!lit) return;
    illuminance += entry.level * known->transport.illuminance;
    radiance += static_cast<float>(entry.level) * known->transport.radiance.array();
  });
  return {illuminance, (radiance / (radiance + kMiddleLuminance)).matrix()};
}

}  // namespace angen::light
