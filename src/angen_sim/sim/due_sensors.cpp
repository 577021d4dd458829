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
  idle_until_.assign(entries_.size(), 0);
  scheduler_.assign(schedules, now);
  counted_.assign(scheduler_.groups().size(), 0);
  for (std::uint32_t index = 0; index < entries_.size(); ++index) {
    if (counts(index)) ++counted_[scheduler_.group_of(index)];
  }
}

/// Whether it publishes at all times of its schedule.
bool DueSensors::counts(std::uint32_t index) const {
  const SensorInstance& sensor = *entries_[index].sensor;
  return !sensor.on_demand() && sensor.error.empty();
}

void DueSensors::note_failing(std::uint32_t index) {
  if (counts(index)) --counted_[scheduler_.group_of(index)];
}

/// Activates sensors near which something has changed, or whose next sample is not known to be
/// without an event.
void DueSensors::activate(const Engines& engines, SensorScheduler::Group& group, Clock clock) {
  if (group.idle.empty()) return;
  activate_changed(engines, group);
  if (group.idle_until <= clock.time) {
    group.idle_until = kForever;
    for (const std::uint32_t index : group.idle) {
      if (is_idle(index, clock)) {
        group.idle_until = std::min(group.idle_until, idle_until_[index]);
      } else {
        scheduler_.activate(index);
      }
    }
  }
  scheduler_.update_lists(group);
}

void DueSensors::activate_changed(const Engines& engines, const SensorScheduler::Group& group) {
  engines.movers.each_changed_since(group.checked, [&](std::uint32_t region) {
    const std::uint32_t index = region < owners_.size() ? owners_[region] : kNobody;
    if (index == kNobody || !scheduler_.is_idle(index)) return;
    if (&scheduler_.group(scheduler_.group_of(index)) != &group) return;
    if (engines.movers.changed_or_warmed_since(region, group.checked)) scheduler_.activate(index);
  });
  const auto states_changed = [&](StateChanges::Fields fields, const Heights& heights) {
    return engines.states.changed_since(fields, heights, group.checked);
  };
  if (!group.queries_devices || !states_changed(group.fields, group.heights)) return;
  for (const std::uint32_t index : group.idle) {
    const Queried& queried = entries_[index].sensor->queried;
    if (queried.devices && states_changed(queried.fields, queried.heights)) {
      scheduler_.activate(index);
    }
  }
}

/// The soonest end of the idle times of the sensors that are still idle.
void DueSensors::renew_idle_until(SensorScheduler::Group& group) const {
  group.idle_until = kForever;
  for (const std::uint32_t index : group.idle) {
    group.idle_until = std::min(group.idle_until, idle_until_[index]);
  }
}

DueSensors::Visit DueSensors::visit(const Engines& engines, std::uint32_t index, Clock clock,
                                    Snapshot& next) {
  SensorInstance& sensor = *entries_[index].sensor;
  if (!sensor.error.empty()) return Visit::kNothing;
  if (sensor.on_demand()) {
    return requested_.has(sensor.kind, sensor.name) ? Visit::kSample : Visit::kNothing;
  }
  const bool changed = !unchanged(engines, entries_[index]);
  sensor.unchanged = changed ? 0 : sensor.unchanged + 1;
  if (!sensor.idle) idle_until_[index] = 0;  // it may depend on `unchanged`
  if (changed || !is_idle(index, clock)) return Visit::kSample;
  if (!sensor.idle && !begin_idle(index, clock, next)) return Visit::kSample;
  stop_visits(engines, index);
  return Visit::kRepeat;
}

/// Queries the sensor again when its last answer is over.
bool DueSensors::is_idle(std::uint32_t index, Clock clock) {
  if (idle_until_[index] <= clock.time) {
    idle_until_[index] = idle_until(*entries_[index].sensor, clock.time - clock.step);
  }
  return idle_until_[index] > clock.time;
}

/// When a sample after the time `after` may next be another.
Nanoseconds DueSensors::idle_until(SensorInstance& sensor, Nanoseconds after) const {
  if (sensor.on_demand()) return 0;
  return sensor.sensor->idle_until(SamplesAhead(sensor.unchanged, sensor.schedule, after, seed_,
                                                sensor.key, sensor.known_noise));
}

bool DueSensors::stays(std::uint32_t index, Clock clock) {
  const SensorInstance& sensor = *entries_[index].sensor;
  return sensor.lasts && sensor.up_to_date && sensor.scans.size() == 1 && sensor.near == nullptr &&
         !sensor.queried.any() && is_idle(index, clock);
}

bool DueSensors::note_sampled(std::uint32_t index, Clock clock) {
  SensorInstance& sensor = *entries_[index].sensor;
  idle_until_[index] = idle_until(sensor, clock.time);
  return idle_until_[index] > clock.time;
}

bool DueSensors::begin_idle(std::uint32_t index, Clock clock, Snapshot& next) {
  SensorInstance& sensor = *entries_[index].sensor;
  if (idle_until_[index] <= clock.time) return false;
  std::shared_ptr<const LazyReading> lazy = sensor.lazy_reading();
  if (lazy ? !sensor.published.reading : !sensor.up_to_date) return false;
  sensor.idle = true;
  if (!lazy) return true;
  const Nanoseconds last = next.stamp(index);
  if (last < clock.time && last != sensor.published.reading->stamp) {
    // The lazy one makes the next publication, not the last one, which repeated a reading.
    auto repeated = std::make_shared<Reading>(*sensor.published.reading);
    repeated->stamp = last;
    sensor.published.reading = std::move(repeated);
  }
  sensor.published.lazy = std::move(lazy);
  next.sensors.set(index, sensor.published);
  return true;
}

bool DueSensors::unchanged(const Engines& engines, const Entry& entry) {
  const SensorInstance& sensor = *entry.sensor;
  if (sensor.near != nullptr && sensor.near->region.changed_since(sensor.seen)) return false;
  const bool scans_changed = std::any_of(
      sensor.scans.begin(), sensor.scans.end(),
      [&](const auto& scan) { return scan != nullptr && scan->region.changed_since(sensor.seen); });
  if (scans_changed) return false;
  return !(sensor.queried.any() || sensor.link_moves) ||
         queries_unchanged(engines, *entry.live, sensor);
}

void DueSensors::stop_visits(const Engines& engines, std::uint32_t index) {
  const SensorInstance& sensor = *entries_[index].sensor;
  if (!sensor.queried.wakes(sensor.near != nullptr)) return;
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
  group.idle_until = std::min(group.idle_until, idle_until_[index]);
  if (!sensor.queried.devices) return;
  group.queries_devices = true;
  group.fields |= sensor.queried.fields;
  group.heights = group.heights | sensor.queried.heights;
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

std::int64_t DueSensors::next_end(Building& building, Clock clock, std::int64_t end, bool moving) {
  if (outdated_) list(building, clock.time);
  const std::int64_t soonest = clock.time / clock.step + 1;
  const Engines& engines = building.engines();
  const auto stop_at = [&](Nanoseconds time) { end = std::min(end, time / clock.step); };
  const auto stop_for = [&](const Schedule& schedule, Nanoseconds until) {
    if (until / clock.step >= end) return;
    stop_at(schedule.next_sample(std::max(clock.time, until - clock.step)));
  };
  stop_at(clock.time + SamplesAhead::kFarthest + clock.step);
  stop_at(std::max(engines.next_light(), clock.time + clock.step));
  for (std::uint32_t number = 0; number < scheduler_.groups().size(); ++number) {
    if (end <= soonest) return soonest;
    SensorScheduler::Group& group = scheduler_.group(number);
    if (group.schedule.next_sample(clock.time) / clock.step >= end) continue;
    if (!group.idle.empty()) {
      activate_changed(engines, group);
      scheduler_.update_lists(group);
      if (group.idle_until / clock.step < end) renew_idle_until(group);
      stop_for(group.schedule, group.idle_until);
    }
    for (const std::uint32_t index : group.active) {
      const SensorInstance& sensor = *entries_[index].sensor;
      if (end <= soonest) return soonest;
      if (!sensor.error.empty()) continue;
      if (sensor.on_demand() && !requested_.has(sensor.kind, sensor.name)) continue;
      const bool is_idle =
          sensor.idle && (!moving || sensor.unchanged > 0) && unchanged(engines, entries_[index]);
      stop_for(sensor.schedule, is_idle ? idle_until_[index] : 0);
    }
  }
  return end;
}

void DueSensors::skip_to(Clock clock, std::int64_t tick, Snapshot& next) {
  const Nanoseconds to = tick * clock.step;
  for (std::size_t number = 0; number < counted_.size(); ++number) {
    const Schedule& schedule = scheduler_.groups()[number].schedule;
    const std::int64_t each = schedule.publications(to) - schedule.publications(clock.time);
    next.counts.readings += counted_[number] * static_cast<std::uint64_t>(each);
  }
  next.new_readings.clear();
  scheduler_.requeue(to);
}

}  // namespace angen::sim
