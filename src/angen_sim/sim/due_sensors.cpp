#include "sim/due_sensors.h"

namespace angen::sim {

namespace {

constexpr std::uint32_t kNobody = UINT32_MAX;

bool light_unchanged(const Engines& engines, const SensorInstance& sensor) {
  if (engines.light.lit_revision() != sensor.light_seen) return false;
  if (engines.light.dark() || engines.changed() < sensor.seen) return true;
  // Walls and doors lead light past them, wherever they are.
  if (!sensor.light || engines.standing_changed() >= sensor.seen) return false;
  return !sensor.light->region.changed_since(sensor.light->sampled);
}

/// Whether the temperature of a surface has changed that its rays may hit.
bool heat_changed(const Engines& engines, const SensorInstance& sensor) {
  const MoverIndex::Moment seen = sensor.seen;
  if (sensor.near == nullptr) return engines.surfaces.changed_since(seen);
  return engines.surfaces.changed_since(seen, sensor.near->box);
}

/// Whether the temperature of such a surface has begun to change.
bool heat_set(const Engines& engines, const SensorInstance& sensor) {
  if (sensor.near == nullptr) return engines.surfaces.set_since(sensor.seen);
  return engines.surfaces.set_since(sensor.seen, sensor.near->box);
}

/// Whether its queries besides rays would have the same answers.
bool queries_unchanged(const Engines& engines, const LiveModel& live,
                       const SensorInstance& sensor) {
  const Queried& queried = sensor.queried;
  const bool moved = engines.changed() >= sensor.seen;  // anything
  if (queried.other && moved) return false;
  const bool model_changed = live.changed >= sensor.seen;
  if (queried.model && model_changed) return false;
  if (queried.heat && heat_changed(engines, sensor)) return false;
  if (queried.heat_set && heat_set(engines, sensor)) return false;
  if (queried.devices &&
      engines.states.changed_since(queried.fields, queried.heights, sensor.seen)) {
    return false;
  }
  if (queried.light && !light_unchanged(engines, sensor)) return false;
  if (queried.contacts && contacts_revision(engines, sensor) != sensor.contacts_seen) return false;
  return !sensor.link_moves || !model_changed || pose_of(engines, live, sensor) == sensor.seen_from;
}

}  // namespace

Pose pose_of(const Engines& engines, const LiveModel& live, const SensorInstance& sensor) {
  return engines.physics.pose(live.parts.links[sensor.link]) * sensor.pose;
}

std::uint64_t contacts_revision(const Engines& engines, const SensorInstance& sensor) {
  std::uint64_t sum = 0;
  for (const physics::CollisionId collision : sensor.touching) {
    sum += engines.physics.contacts_revision(collision);
  }
  return sum;
}

const std::vector<std::uint32_t>& DueSensors::collect(Building& building, Clock clock) {
  if (outdated_) list(building, clock.time - clock.step);
  groups_ = scheduler_.collect(clock.time);
  due_.clear();
  for (const std::uint32_t number : groups_) {
    SensorScheduler::Group& group = scheduler_.group(number);
    activate(building.engines(), group, clock);
    const std::size_t others = due_.size();
    due_.insert(due_.end(), group.active.begin(), group.active.end());
    merge_from(due_, others);
  }
  return due_;
}

void DueSensors::list(Building& building, Nanoseconds now) {
  outdated_ = false;
  entries_.clear();
  owners_.clear();
  std::vector<Schedule> schedules;
  for (auto& live : building.models()) {
    for (SensorInstance& sensor : live->sensors) {
      schedules.push_back(sensor.schedule);
      entries_.push_back({live.get(), &sensor});
    }
  }
  checked_.assign(entries_.size(), kForever);
  scheduler_.assign(schedules, now);
}

void DueSensors::activate(const Engines& engines, SensorScheduler::Group& group, Clock clock) {
  if (group.idle.empty()) return;
  activate_changed(engines, group);
  if (group.next_check <= clock.time) activate_for_events(group, clock);
  scheduler_.update_lists(group);
}

void DueSensors::activate_changed(const Engines& engines, const SensorScheduler::Group& group) {
  engines.movers.each_changed_since(group.checked, [&](std::uint32_t region) {
    const std::uint32_t index = region < owners_.size() ? owners_[region] : kNobody;
    if (index == kNobody || !scheduler_.is_idle(index)) return;
    if (&scheduler_.group(scheduler_.group_of(index)) != &group) return;
    if (engines.movers.changed_or_warmed_since(region, group.checked)) scheduler_.activate(index);
  });
}

/// Activates sensors whose noise may cause an event now.
void DueSensors::activate_for_events(SensorScheduler::Group& group, Clock clock) {
  group.next_check = kForever;
  for (const std::uint32_t index : group.idle) {
    if (checked_[index] <= clock.time) {
      SensorInstance& sensor = *entries_[index].sensor;
      if (!has_no_event(sensor, clock)) {
        scheduler_.activate(index);
        continue;
      }
      checked_[index] = next_check(sensor, clock);
    }
    group.next_check = std::min(group.next_check, checked_[index]);
  }
}

DueSensors::Visit DueSensors::visit(const Engines& engines, std::uint32_t index, Clock clock) {
  SensorInstance& sensor = *entries_[index].sensor;
  if (!sensor.error.empty()) return Visit::kNothing;
  if (sensor.activity.state() == SensorActivity::State::kActive && sensor.on_demand()) {
    return requested_.has(sensor.kind, sensor.name) ? Visit::kSample : Visit::kNothing;
  }
  if (!unchanged(engines, entries_[index])) {
    sensor.activity.note_changed();
    return Visit::kSample;
  }
  sensor.activity.note_unchanged();
  return needs_no_sample(sensor, clock) ? Visit::kPublish : Visit::kSample;
}

/// Whether a sensor for which nothing has changed can do without a sample.
bool DueSensors::needs_no_sample(SensorInstance& sensor, Clock clock) const {
  const SensorActivity& activity = sensor.activity;
  if (activity.steady()) return true;
  if (activity.state() == SensorActivity::State::kActive || !sensor.published.reading) return false;
  if (!activity.lazy()) {
    const NoisySensor* noisy = sensor.noisy;
    if (!activity.settled(noisy != nullptr ? noisy->memory() : 0)) return false;
    NoiseForecast& forecast = sensor.forecast;
    const Nanoseconds event = noisy != nullptr ? noisy->next_event() : kForever;
    if (event != forecast.next_event) forecast = {};
    forecast.next_event = event;
    forecast.no_event_probability = noisy != nullptr ? noisy->no_event_probability() : 1.0;
  }
  return has_no_event(sensor, clock);
}

bool DueSensors::unchanged(const Engines& engines, const Entry& entry) {
  const SensorInstance& sensor = *entry.sensor;
  if ((sensor.queried.any() || sensor.link_moves) &&
      !queries_unchanged(engines, *entry.live, sensor)) {
    return false;
  }
  if (sensor.near != nullptr && sensor.near->region.changed_since(sensor.seen)) return false;
  return std::none_of(sensor.scans.begin(), sensor.scans.end(), [&](const auto& scan) {
    return scan != nullptr && scan->region.changed_since(sensor.seen);
  });
}

/// A sensor that only changes in its watch regions, or of its model, can activate is not visited
/// until then.
void DueSensors::make_idle(const Engines& engines, std::uint32_t index, Clock clock) {
  SensorInstance& sensor = *entries_[index].sensor;
  if (!sensor.activity.skips() || !sensor.queried.only_in_regions(sensor.near != nullptr)) return;
  const auto known = [](const auto& watched) {
    return watched && watched->region.number() != kNobody;
  };
  if (!std::all_of(sensor.scans.begin(), sensor.scans.end(), known)) return;
  if (sensor.near && !known(sensor.near)) return;
  owners_.resize(std::max(owners_.size(), engines.movers.region_count()), kNobody);
  for (const auto& scan : sensor.scans) owners_[scan->region.number()] = index;
  if (sensor.near) owners_[sensor.near->region.number()] = index;
  scheduler_.make_idle(index);
  SensorScheduler::Group& group = scheduler_.group(scheduler_.group_of(index));
  checked_[index] = sensor.activity.lazy() ? next_check(sensor, clock) : kForever;
  group.next_check = std::min(group.next_check, checked_[index]);
}

void DueSensors::publish_idle(const Engines& engines, Clock clock, Snapshot& next) {
  for (const std::uint32_t number : groups_) {
    SensorScheduler::Group& group = scheduler_.group(number);
    if (group.publishes(clock.time)) {
      const std::size_t others = next.new_readings.size();
      next.new_readings.insert(next.new_readings.end(), group.idle.begin(), group.idle.end());
      merge_from(next.new_readings, others);
      next.counts.readings += group.idle.size();
    }
    scheduler_.update_lists(group);
    group.checked = engines.movers.now() + 1;
  }
}

void DueSensors::note_moved(const LiveModel& live) {
  if (outdated_) return;
  for (std::uint32_t i = 0; i < live.sensors.size(); ++i) {
    if (scheduler_.is_idle(live.first_sensor + i)) scheduler_.activate(live.first_sensor + i);
  }
}

}  // namespace angen::sim
