// The part of Lighting that computes the light at places.
#include <algorithm>
#include <utility>

#include "light/field.h"
#include "light/lighting.h"
#include "light/receiver.h"

namespace angen::light {
namespace {

// Half of the color range: about the luminance of a white wall at 200 lx.
constexpr float kMiddleLuminance = 50.0F;     // cd/m^2
constexpr std::int64_t kDeliveryRays = 5000;  // about 1 ms
constexpr std::size_t kMaxReceivers = 256;    // from this number on, expired ones are removed
// Measured costs in rays; they decide only how the work is divided into ticks.
constexpr std::size_t kCostToSee = 8000;     // the surfaces around a place
constexpr std::size_t kCostOfMovers = 2000;  // the movers in front of them
constexpr std::size_t kCostOfLamp = 1500;
constexpr std::size_t kCostOfFarLamp = 100;
constexpr std::size_t kCostOfPatch = 500;  // with the patches that it sees

/// Cost of a lamp's light at a place whose patches are counted.
std::size_t cost_of(const Gather& gather, const Source& source, bool with_movers) {
  if (!gather.may_see(source.solution.bounds)) return kCostOfFarLamp;
  return kCostOfLamp + (with_movers ? kCostOfMovers : 0);
}

bool take(std::size_t cost, std::size_t& left) {
  if (cost > left) return false;
  left -= cost;
  return true;
}

}  // namespace

template <class F>
void Lighting::each_ahead(F&& visit) const {
  for (const std::weak_ptr<Receiver>& each : receivers_) {
    const std::shared_ptr<Receiver> receiver = each.lock();
    if (receiver && receiver->ahead) visit(receiver);
  }
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
    if (probe.ahead) {  // ready before a lamp is lit
      deliveries_.push_back({probe.receiver, std::nullopt});
      busy_ = true;
    }
  }
  Receiver& receiver = *probe.receiver;
  receiver.ahead = probe.ahead;
  if (receiver.pose == pose) return receiver;
  receiver.drop();
  receiver.pose = pose;
  return receiver;
}

void Lighting::queue(const std::shared_ptr<Receiver>& receiver, LampId lamp) const {
  if (std::exchange(receiver->of(lamp).queued, true)) return;
  deliveries_.push_back({receiver, lamp});
  busy_ = true;
}

void Lighting::queue_all(LampId lamp) const {
  each_ahead([&](const std::shared_ptr<Receiver>& receiver) { queue(receiver, lamp); });
}

/// Drops the surfaces of places that changes of static shapes in the box affect.
void Lighting::drop_near(const Eigen::AlignedBox3d& box) const {
  for (const std::weak_ptr<Receiver>& each : receivers_) {
    const std::shared_ptr<Receiver> receiver = each.lock();
    if (!receiver || !receiver->intersects(box)) continue;
    const bool saw = receiver->gather != nullptr;
    receiver->drop();
    if (saw && receiver->ahead) deliveries_.push_back({each, std::nullopt});
  }
}

Source Lighting::source(LampId id, const Entry& entry) const {
  return {id, entry.lamp, *entry.solution, entry.geometry, entry.stale};
}

/// Identifies the inputs of a transport except movers. Of a stale solution, the begin and end of
/// each update of the field count.
std::uint64_t Lighting::key_of(const Source& source) const {
  std::uint64_t key = source.solution.stamp;
  const std::uint64_t field = source.stale ? ~field_->revision() : field_->updates();
  for (const std::uint64_t part : {source.geometry, field}) {
    key = (key ^ part) * 0x9e3779b97f4a7c15ULL + part;
  }
  return key;
}

void Lighting::see(Receiver& receiver) const {
  if (!receiver.gather) receiver.gather = std::make_unique<Gather>(scene_, *field_, receiver.pose);
}

/// A lamp that lights no surface in view of the place gives direct light only.
void Lighting::find(Receiver& receiver, const Source& source) const {
  see(receiver);
  Eigen::AlignedBox3d reach(receiver.pose.position);
  Gathered gathered;
  if (receiver.gather->may_see(source.solution.bounds)) {
    gathered = receiver.gather->gather(source, reach);
  }
  Receiver::Known& known = receiver.of(source.id);
  known.transport = transport(scene_, receiver.pose, source.lamp, gathered, reach);
  known.found = true;
  known.key = key_of(source);
  known.scene = scene_.revision();
}

/// Whether the tick's budget pays for the lamp's light; subtracts the cost.
bool Lighting::affords(Receiver& receiver, const Source& source) const {
  if (!receiver.gather && !take(kCostToSee, budget_)) return false;
  see(receiver);
  const std::size_t patches = receiver.gather->lacking(source) * kCostOfPatch;
  const bool with_movers = !receiver.gather->movers_known();
  return take(patches + cost_of(*receiver.gather, source, with_movers), budget_);
}

Sample Lighting::measure(Probe& probe, const Pose& pose, bool still) const {
  if (paced_) {
    follow();
  } else {
    complete(INT64_MAX);
  }
  Receiver& place = receiver(probe, pose);
  place.note(scene_.revision(), still, probe.reach);
  const bool ahead = paced_ && place.ahead && budget_ <= kMeasureRays;
  const bool bounded = ahead && place.begun;
  place.begun = true;
  probe.reach = Eigen::AlignedBox3d(pose.position);
  // A dark lamp's transport is computed when it is lit; lamps are independent of each other.
  double illuminance = 0.0;
  Eigen::Array3f radiance = Eigen::Array3f::Zero();
  lamps_.each([&](LampId id, const Entry& entry) {
    const bool lit = entry.level > 0.0 && entry.solution != nullptr;
    if (lit) {
      Source from = source(id, entry);
      if (!place.of(id).holds(key_of(from), scene_.revision())) {
        if (!bounded) see(place);
        if (ahead && !bounded && !take(place.gather->lacking(from) * kCostOfPatch, budget_)) {
          from.stale = true;  // the first value lacks light that no solution has followed yet
          queue(probe.receiver, id);
        }
        if (!bounded || affords(place, from)) {
          find(place, from);
        } else {
          queue(probe.receiver, id);
        }
      }
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

void Lighting::expect(Probe& probe, const Pose& pose) {
  prepare();
  probe.ahead = true;
  receiver(probe, pose).begun = true;
  lamps_.each([&](LampId id, const Entry& entry) {
    if (entry.level > 0.0 && entry.solution) queue(probe.receiver, id);
  });
}

/// Computes the light at places ahead of measure(). Counts the cost even if measure() has computed
/// some of it, so that queries leave no trace.
void Lighting::deliver() {
  const std::int64_t allowed = std::min(kDeliveryRays, delivering_.left());
  std::int64_t left = allowed;
  while (left > 0 && !deliveries_.empty() && !field_->updating()) {
    const Delivery delivery = deliveries_.front();
    if (const std::shared_ptr<Receiver> receiver = delivery.receiver.lock()) {
      if (!std::exchange(receiver->counted, true)) left -= kCostToSee;
      see(*receiver);
      if (delivery.lamp && !deliver(*receiver, *delivery.lamp, left)) break;
    }
    deliveries_.pop_front();
  }
  delivering_.spend(allowed - left);
}

/// False if it continues in a later tick.
bool Lighting::deliver(Receiver& receiver, LampId lamp, std::int64_t& left) {
  if (!lamps_.contains(lamp)) return true;
  const Entry& entry = lamps_.at(lamp);
  Receiver::Known& known = receiver.of(lamp);
  if (entry.level > 0.0 && entry.solution) {
    const Source from = source(lamp, entry);
    if (!receiver.gather->prepare(from, left)) return false;
    if (left <= 0) return false;
    left -= static_cast<std::int64_t>(cost_of(*receiver.gather, from, true));
    if (!known.holds(key_of(from), scene_.revision())) {
      find(receiver, from);
      ++lit_revision_;
    }
  }
  known.queued = false;
  return true;
}

}  // namespace angen::light
