#include "light/lighting.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "light/receiver.h"

namespace angen::light {
namespace {

constexpr Nanoseconds kRest = kSecond / 10;  // changes are taken over after this time without one
constexpr Nanoseconds kLongestWait = 5 * kSecond;
// Half of the color range: about the luminance of a white wall at 200 lx.
constexpr float kMiddleLuminance = 50.0F;   // cd/m^2
constexpr std::size_t kMaxReceivers = 256;  // from this number on, expired ones are removed

/// Unique: a probe that outlives its Lighting (reset of the world) is unknown to the next one.
std::uint64_t next_id() {
  static std::atomic<std::uint64_t> made{0};
  return made++;
}

}  // namespace

Lighting::Lighting(const rays::Scene& scene)
    : scene_(scene), field_(std::make_unique<Field>(scene)), id_(next_id()) {}

Lighting::~Lighting() = default;

void Lighting::count(double before, double after) {
  if (before > 0.0) --lit_count_;
  if (after > 0.0) ++lit_count_;
  if (before > 0.0 || after > 0.0) ++lit_revision_;
}

LampId Lighting::add(const Lamp& lamp, double level) {
  count(0.0, level);
  switched_ = switched_ || level > 0.0;
  return lamps_.add({lamp, level, nullptr});
}

void Lighting::remove(LampId lamp) {
  count(level(lamp), 0.0);
  lamps_.remove(lamp);
  for (const std::weak_ptr<Receiver>& each : receivers_) {
    const std::shared_ptr<Receiver> receiver = each.lock();
    if (receiver && receiver->gather) receiver->gather->forget(lamp);
  }
}

void Lighting::set_level(LampId lamp, double level) {
  Entry& entry = lamps_.at(lamp);
  if (entry.level == level) return;
  count(entry.level, level);
  if (!(entry.level > 0.0)) entry.switched_on = switched_ = true;
  entry.level = level;
}

double Lighting::level(LampId lamp) const { return lamps_.at(lamp).level; }

void Lighting::move(LampId lamp, const Pose& pose) {
  Entry& entry = lamps_.at(lamp);
  if (entry.lamp.pose == pose) return;
  entry.lamp.pose = pose;
  entry.moved = changed_ = true;
  ++entry.geometry;
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
  const std::pair now(lit_revision_, field_->forgotten());
  if (reflected_ && reflected_revision_ == now) return reflected_;
  std::vector<Rgb> light;
  lamps_.each([&](LampId, const Entry& entry) {
    if (!(entry.level > 0.0) || !entry.solution) return;
    Rgb factor = Rgb::Zero();
    factor.head<3>() = static_cast<float>(entry.level) * entry.lamp.color.array();
    add_reflected(*field_, *entry.solution, factor, light);
  });
  reflected_ = std::make_shared<const ReflectedLight>(field_->pieces(light));
  reflected_revision_ = now;
  return reflected_;
}

/// Notes the standing shapes that have changed.
void Lighting::follow() const {
  for (const Field::Change& change : field_->follow()) {
    changed_ = true;
    if (!change.is_static) continue;
    drop_near(change.box);
    lamps_.each([&](LampId, Entry& entry) {
      if (!entry.solution || entry.solution->bounds.intersects(change.box)) ++entry.geometry;
    });
  }
}

/// Whether the lamp or standing shapes in its light have changed since it was solved.
bool Lighting::is_outdated(const Entry& entry) const {
  return entry.moved || field_->outdated_in(entry.solution->bounds);
}

/// Whether a lamp was switched on whose light among the present shapes is unknown.
bool Lighting::lacks_light() const {
  if (!std::exchange(switched_, false)) return false;
  bool any = false;
  lamps_.each([&](LampId, Entry& entry) {
    const bool on = std::exchange(entry.switched_on, false) && entry.level > 0.0;
    any = any || (entry.level > 0.0 && !entry.solution) || (on && is_outdated(entry));
  });
  return any;
}

/// Finds the light of all lit lamps between the surfaces of the present shapes.
void Lighting::take_over() const {
  waiting_ = changed_ = false;
  lamps_.each([&](LampId, Entry& entry) {
    if (entry.solution && is_outdated(entry)) entry.solution = nullptr;
  });
  field_->update();
  lamps_.each([&](LampId, Entry& entry) {
    if (!(entry.level > 0.0) || entry.solution) return;
    entry.solution = std::make_shared<const Solution>(solve(entry.lamp, *field_));
    entry.moved = false;
    ++lit_revision_;
  });
}

void Lighting::keep_time() {
  if (std::exchange(keeps_time_, true)) return;
  follow();
  take_over();
}

bool Lighting::is_due(Nanoseconds now) const {
  if (!waiting_) return false;
  const bool went_back = now < last_change_;
  return went_back || now - last_change_ >= kRest || now - first_change_ >= kLongestWait;
}

void Lighting::advance(Nanoseconds now) {
  if (dark()) return;
  follow();
  if (std::exchange(changed_, false)) {
    if (!waiting_) first_change_ = now;
    last_change_ = now;
    waiting_ = true;
  }
  if (lacks_light() || is_due(now)) take_over();
}

std::optional<Nanoseconds> Lighting::next() const {
  if (dark()) return std::nullopt;
  if (switched_ || changed_) return 0;
  if (!waiting_) return std::nullopt;
  return std::min(last_change_ + kRest, first_change_ + kLongestWait);
}

Receiver& Lighting::receiver(Probe& probe, const Pose& pose) const {
  if (!knows(probe)) {
    probe.receiver = std::make_shared<Receiver>(pose);
    probe.lighting = id_;
    probe.reach = Eigen::AlignedBox3d(pose.position);
    if (receivers_.size() >= kMaxReceivers) {
      const auto expired = [](const std::weak_ptr<Receiver>& each) { return each.expired(); };
      receivers_.erase(std::remove_if(receivers_.begin(), receivers_.end(), expired),
                       receivers_.end());
    }
    receivers_.push_back(probe.receiver);
  }
  Receiver& receiver = *probe.receiver;
  if (receiver.pose == pose) return receiver;
  receiver.drop();
  receiver.pose = pose;
  return receiver;
}

/// Drops the surfaces of places that changes of static shapes in the box affect.
void Lighting::drop_near(const Eigen::AlignedBox3d& box) const {
  for (const std::weak_ptr<Receiver>& each : receivers_) {
    const std::shared_ptr<Receiver> receiver = each.lock();
    if (receiver && receiver->intersects(box)) receiver->drop();
  }
}

/// A lamp that lights no surface in view of the place gives direct light only.
void Lighting::find(Receiver& receiver, const Source& source) const {
  if (!receiver.gather) receiver.gather = std::make_unique<Gather>(scene_, *field_, receiver.pose);
  Eigen::AlignedBox3d reach(receiver.pose.position);
  Gathered gathered;
  if (receiver.gather->may_see(source.solution.bounds)) {
    gathered = receiver.gather->gather(source, reach);
  }
  Receiver::Known& known = receiver.of(source.id);
  known.transport = transport(scene_, receiver.pose, source.lamp, gathered, reach);
  known.found = true;
  known.stamp = source.solution.stamp;
  known.geometry = source.geometry;
  known.scene = scene_.revision();
}

Sample Lighting::measure(Probe& probe, const Pose& pose, bool still) const {
  follow();
  if (lacks_light() || !keeps_time_) take_over();
  Receiver& place = receiver(probe, pose);
  place.note(scene_.revision(), still, probe.reach);
  probe.reach = Eigen::AlignedBox3d(pose.position);
  // A dark lamp's transport is computed when it is lit; lamps are independent of each other.
  double illuminance = 0.0;
  Eigen::Array3f radiance = Eigen::Array3f::Zero();
  lamps_.each([&](LampId id, const Entry& entry) {
    const bool lit = entry.level > 0.0;
    if (lit) {
      const Source from{id, entry.lamp, *entry.solution, entry.geometry, is_outdated(entry)};
      if (!place.of(id).holds(from, scene_.revision())) find(place, from);
    }
    const Receiver::Known* known = place.find(id);
    if (known == nullptr || (!lit && known->scene != scene_.revision())) return;
    probe.reach.extend(known->transport.reach);
    if (!lit) return;
    illuminance += entry.level * known->transport.illuminance;
    radiance += static_cast<float>(entry.level) * known->transport.radiance.array();
  });
  return {illuminance, (radiance / (radiance + kMiddleLuminance)).matrix()};
}

}  // namespace angen::light
