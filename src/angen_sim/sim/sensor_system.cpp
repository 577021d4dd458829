#include "sim/sensor_system.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "sim/guard.h"

namespace angen::sim {

namespace {

constexpr int kMostRaySets = 256;  // of one sensor that are cached
constexpr std::uint32_t kNobody = UINT32_MAX;
const std::uint64_t kOwnDraws = hash_bytes("own draws");

/// Entries from `middle` on were appended; both parts ascend.
void merge_from(std::vector<std::uint32_t>& list, std::size_t middle) {
  std::inplace_merge(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(middle), list.end());
}

bool publishes(const SensorInstance& sensor, InstanceView::Clock clock) {
  return !sensor.published.reading ||
         sensor.schedule.last_publication(clock.time) > clock.time - clock.step;
}

Pose pose_of(const Engines& engines, const LiveModel& live, const SensorInstance& sensor) {
  return engines.physics.pose(live.parts.links[sensor.link]) * sensor.pose;
}

/// Whether it is where it was at its last sample; otherwise its cached scans are dropped.
bool stands_still(const Engines& engines, const LiveModel& live, SensorInstance& sensor) {
  if (!sensor.link_moves) return true;
  const Pose pose = pose_of(engines, live, sensor);
  if (pose == sensor.seen_from) return true;
  sensor.seen_from = pose;
  sensor.scans.clear();
  return false;
}

std::uint64_t contacts_revision(const Engines& engines, const SensorInstance& sensor) {
  std::uint64_t sum = 0;
  for (const physics::CollisionId collision : sensor.touching) {
    sum += engines.physics.contacts_revision(collision);
  }
  return sum;
}

bool light_unchanged(const Engines& engines, const SensorInstance& sensor) {
  if (engines.light.lit_revision() != sensor.light_seen) return false;
  if (engines.light.dark() || engines.changed() < sensor.seen) return true;
  // Walls and doors lead light past them, wherever they are.
  if (!sensor.light || engines.standing_changed() >= sensor.seen) return false;
  return !sensor.light->region.changed_since(sensor.light->sampled);
}

/// Whether its queries besides rays would have the same answers.
bool queries_unchanged(const Engines& engines, const LiveModel& live,
                       const SensorInstance& sensor) {
  const Queried& queried = sensor.queried;
  const bool moved = engines.changed() >= sensor.seen;  // anything
  if (queried.other && moved) return false;
  const bool model_changed = live.changed >= sensor.seen;
  if (queried.model && model_changed) return false;
  if (queried.heat && engines.surfaces.changed_since(sensor.seen)) return false;
  if (queried.devices && engines.states.changed_since(queried.fields, sensor.seen)) return false;
  if (queried.light && !light_unchanged(engines, sensor)) return false;
  if (queried.contacts && contacts_revision(engines, sensor) != sensor.contacts_seen) return false;
  return !sensor.link_moves || !model_changed || pose_of(engines, live, sensor) == sensor.seen_from;
}

/// Whether the latest reading has nothing that the last published one has not.
bool as_published(const SensorInstance& sensor) {
  const Reading& reading = sensor.latest;
  return sensor.activity.published() && !reading.urgent &&
         reading.event == sensor.published.reading->event &&
         reading.same_values(*sensor.published.reading);
}

}  // namespace

void SensorSystem::sample(Building& building, InstanceView::Clock clock, std::int64_t tick,
                          Snapshot& next) {
  if (outdated_) list(building, clock.time - clock.step);
  Engines& engines = building.engines();
  engines.advance_light(clock.time);
  const std::vector<std::uint32_t>& groups = scheduler_.collect(clock.time);
  if (!groups.empty()) {
    for (const std::uint32_t group : groups) activate(engines, scheduler_.group(group), clock);
    meter_.rest.sensors += meter_.watch.lap();
    visit_due(building, groups, clock, next);
    cast(engines);
    const std::size_t repeated = next.new_readings.size();
    for (const Sample& sample : samples_) read(building, sample, clock, tick, next);
    merge_from(next.new_readings, repeated);
    for (const std::uint32_t group : groups) {
      publish_idle(scheduler_.group(group), engines, clock, next);
    }
  }
  engines.movers.advance();
  meter_.rest.sensors += meter_.watch.lap();
}

void SensorSystem::visit_due(Building& building, const std::vector<std::uint32_t>& groups,
                             InstanceView::Clock clock, Snapshot& next) {
  due_.clear();
  for (const std::uint32_t group : groups) {
    const std::vector<std::uint32_t>& active = scheduler_.group(group).active;
    const std::size_t others = due_.size();
    due_.insert(due_.end(), active.begin(), active.end());
    merge_from(due_, others);
  }
  samples_.clear();
  rays_.clear();
  for (const std::uint32_t index : due_) {
    visit(building, index, clock, next);
    if (meter_.on) entries_[index].sensor->cost += meter_.watch.lap();
  }
}

/// The part of a due time that idle sensors have: they publish again what stands.
void SensorSystem::publish_idle(SensorScheduler::Group& group, const Engines& engines,
                                InstanceView::Clock clock, Snapshot& next) {
  if (group.publishes(clock.time)) {
    const std::size_t others = next.new_readings.size();
    next.new_readings.insert(next.new_readings.end(), group.idle.begin(), group.idle.end());
    merge_from(next.new_readings, others);
    next.counts.readings += group.idle.size();
  }
  scheduler_.update_lists(group);
  group.checked = engines.movers.now() + 1;
}

void SensorSystem::activate(const Engines& engines, SensorScheduler::Group& group,
                            InstanceView::Clock clock) {
  if (group.idle.empty()) return;
  activate_changed(engines, group);
  if (group.next_check <= clock.time) activate_loud(group, clock);
  scheduler_.update_lists(group);
}

void SensorSystem::activate_changed(const Engines& engines, const SensorScheduler::Group& group) {
  engines.movers.each_changed_since(group.checked, [&](std::uint32_t region) {
    const std::uint32_t index = region < owners_.size() ? owners_[region] : kNobody;
    if (index == kNobody || !scheduler_.is_idle(index)) return;
    if (&scheduler_.group(scheduler_.group_of(index)) != &group) return;
    if (engines.movers.changed_since(region, group.checked)) scheduler_.activate(index);
  });
}

/// Those whose noise may cause an event now.
void SensorSystem::activate_loud(SensorScheduler::Group& group, InstanceView::Clock clock) {
  group.next_check = kForever;
  for (const std::uint32_t index : group.idle) {
    if (checked_[index] <= clock.time) {
      SensorInstance& sensor = *entries_[index].sensor;
      if (!quiet(sensor, clock)) {
        scheduler_.activate(index);
        continue;
      }
      checked_[index] = next_check(sensor, clock);
    }
    group.next_check = std::min(group.next_check, checked_[index]);
  }
}

void SensorSystem::cast(Engines& engines) {
  if (rays_.empty()) return;
  engines.rays.commit();
  hits_.resize(rays_.size());
  engines.rays.cast(rays_.data(), hits_.data(), rays_.size());
  const Nanoseconds spent = meter_.watch.lap();
  if (spent == 0) return;
  const auto all = static_cast<Nanoseconds>(rays_.size());
  for (const Sample& sample : samples_) {  // each sensor pays for its rays
    entries_[sample.index].sensor->cost += spent * static_cast<Nanoseconds>(sample.ray_count) / all;
  }
}

void SensorSystem::list(Building& building, Nanoseconds now) {
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

void SensorSystem::note_moved(const LiveModel& live) {
  if (outdated_) return;
  for (std::uint32_t i = 0; i < live.sensors.size(); ++i) {
    if (scheduler_.is_idle(live.first_sensor + i)) scheduler_.activate(live.first_sensor + i);
  }
}

/// A sensor that only changes in its watch regions, or of its model, can activate is not visited
/// until then.
void SensorSystem::make_idle(const Engines& engines, std::uint32_t index,
                             InstanceView::Clock clock) {
  SensorInstance& sensor = *entries_[index].sensor;
  if (sensor.queried.others() || !sensor.activity.skips()) return;
  const auto known = [](const auto& scan) { return scan && scan->region.number() != kNobody; };
  if (!std::all_of(sensor.scans.begin(), sensor.scans.end(), known)) return;
  owners_.resize(std::max(owners_.size(), engines.movers.region_count()), kNobody);
  for (const auto& scan : sensor.scans) owners_[scan->region.number()] = index;
  scheduler_.make_idle(index);
  SensorScheduler::Group& group = scheduler_.group(scheduler_.group_of(index));
  checked_[index] = sensor.activity.lazy() ? next_check(sensor, clock) : kForever;
  group.next_check = std::min(group.next_check, checked_[index]);
}

/// Whether the sensor, for which nothing has changed, needs no sample now; if so it has published.
bool SensorSystem::skip_sample(std::uint32_t index, InstanceView::Clock clock, Snapshot& next) {
  SensorInstance& sensor = *entries_[index].sensor;
  SensorActivity& activity = sensor.activity;
  if (activity.steady()) {
    if (publishes(sensor, clock)) publish(index, clock.time, next);
    return true;
  }
  if (activity.state() == SensorActivity::State::kActive || !sensor.published.reading) return false;
  if (!activity.lazy()) {
    if (!activity.settled(sensor.noisy != nullptr ? sensor.noisy->memory() : 0)) return false;
    sensor.forecast.quiet_chance = sensor.noisy != nullptr ? sensor.noisy->quiet_chance() : 1.0;
  }
  if (!quiet(sensor, clock)) return false;
  if (!activity.lazy()) {
    sensor.published.lazy = sensor.lazy_reading();
    activity.become_lazy();
    next.sensors.set(index, sensor.published);
  }
  if (publishes(sensor, clock)) repeat(index, next);
  return true;
}

/// Ends the time in which the sensor's lazy reading stood for its samples.
void SensorSystem::resume(std::uint32_t index, InstanceView::Clock clock, Snapshot& next) {
  SensorInstance& sensor = *entries_[index].sensor;
  sensor.activity.resume();
  const Nanoseconds last = sensor.schedule.last_sample(clock.time - clock.step);
  if (sensor.noisy != nullptr) {
    sensor.noisy->resume(last, draws_at(sensor.schedule, last, seed_, sensor.key));
  }
  if (publishes(sensor, clock)) return;
  sensor.published = {next.reading(index), nullptr};  // it may be lazy again before the next
  next.sensors.set(index, sensor.published);
}

void SensorSystem::repeat(std::uint32_t index, Snapshot& next) {
  next.new_readings.push_back(index);
  ++next.counts.readings;
}

/// The sensor has thrown `error`: its last reading stands, and says so.
void SensorSystem::fail(std::uint32_t index, const std::string& error, Nanoseconds now,
                        Snapshot& next) {
  SensorInstance& sensor = *entries_[index].sensor;
  sensor.error = error;
  sensor.scans.clear();
  if (sensor.activity.lazy()) sensor.activity.resume();
  sensor.latest.stamp = now;
  sensor.latest.set(kErrorField, error);
  sensor.published = {std::make_shared<const Reading>(sensor.latest), nullptr};
  next.sensors.set(index, sensor.published);
  next.events.push_back({now, sensor.name, sensor.kind, "failed", error});
}

void SensorSystem::visit(Building& building, std::uint32_t index, InstanceView::Clock clock,
                         Snapshot& next) {
  SensorInstance& sensor = *entries_[index].sensor;
  if (!sensor.error.empty()) return;
  if (sensor.activity.state() == SensorActivity::State::kActive && sensor.on_demand()) {
    if (!requested_.has(sensor.kind, sensor.name)) return;
  } else if (unchanged(building.engines(), entries_[index])) {
    sensor.activity.note_unchanged();
    if (skip_sample(index, clock, next)) {
      make_idle(building.engines(), index, clock);
      return;
    }
  } else {
    sensor.activity.note_changed();
  }
  if (sensor.activity.lazy()) resume(index, clock, next);
  const std::size_t others = rays_.size();
  const std::string thrown = thrown_by([&] { aim(building, index, clock); });
  if (thrown.empty()) return;
  rays_.resize(others);
  fail(index, thrown, clock.time, next);
}

bool SensorSystem::unchanged(const Engines& engines, const Entry& entry) {
  const SensorInstance& sensor = *entry.sensor;
  if ((sensor.queried.any() || sensor.link_moves) &&
      !queries_unchanged(engines, *entry.live, sensor)) {
    return false;
  }
  return std::none_of(sensor.scans.begin(), sensor.scans.end(), [&](const auto& scan) {
    return scan != nullptr && scan->region.changed_since(sensor.seen);
  });
}

void SensorSystem::aim(Building& building, std::uint32_t index, InstanceView::Clock clock) {
  Engines& engines = building.engines();
  SensorInstance& sensor = *entries_[index].sensor;
  const InstanceView view(building, *entries_[index].live, clock, &sensor);
  Sample sample{index, nullptr, {}, rays_.size(), 0};
  const int ray_set = sensor.sensor->ray_set(view);
  const bool still = stands_still(engines, *entries_[index].live, sensor);
  if (still && ray_set >= 0 && ray_set < kMostRaySets) {
    if (sensor.scans.size() <= static_cast<std::size_t>(ray_set)) sensor.scans.resize(ray_set + 1);
    std::unique_ptr<CachedScan>& scan = sensor.scans[ray_set];
    if (!scan) {
      RayBatch rays;
      sensor.sensor->aim(view, rays);
      engines.rays.commit();
      scan = std::make_unique<CachedScan>(std::move(rays), engines);
    } else if (scan->region.take_static_change()) {
      engines.rays.commit();
      scan->measure(engines);
    }
    sample.scan = scan.get();
  } else {
    sensor.sensor->aim(view, rays_);
    sample.ray_count = rays_.size() - sample.first_ray;
  }
  sample.queried = view.queried();
  samples_.push_back(sample);
}

/// `same`: they are those of the last sample.
Hits SensorSystem::hits_of(Engines& engines, const Sample& sample, bool& same) {
  if (sample.scan == nullptr) return {hits_.data() + sample.first_ray, sample.ray_count};
  same = sample.scan->cast(engines, split_, cached_hits_);
  return {cached_hits_.data(), cached_hits_.size()};
}

void SensorSystem::read(Building& building, const Sample& sample, InstanceView::Clock clock,
                        std::int64_t tick, Snapshot& next) {
  SensorInstance& sensor = *entries_[sample.index].sensor;
  Engines& engines = building.engines();
  bool same = false;
  const Hits hits = hits_of(engines, sample, same);
  sensor.seen = engines.movers.now() + 1;
  if (!same || !sensor.activity.steady() || sensor.queried.any()) {
    const std::string thrown = thrown_by([&] { measure(building, sample, hits, clock, tick); });
    if (!thrown.empty()) {
      fail(sample.index, thrown, clock.time, next);
      return;
    }
    const Reading& reading = sensor.latest;
    if (!reading.event.empty()) {
      next.events.push_back(
          {clock.time, sensor.name, sensor.kind, reading.event, reading.event_detail});
    }
  }
  if (publishes(sensor, clock) || (sensor.latest.urgent && !sensor.activity.published())) {
    publish(sample.index, clock.time, next);
  }
  sensor.cost += meter_.watch.lap();
}

/// Reads the sensor, adds its noise, and notes what its next samples depend on.
void SensorSystem::measure(Building& building, const Sample& sample, Hits hits,
                           InstanceView::Clock clock, std::int64_t tick) {
  SensorInstance& sensor = *entries_[sample.index].sensor;
  const Engines& engines = building.engines();
  const bool has_noise = !sensor.noise.empty();
  Reading& reading = has_noise ? sensor.clean : sensor.latest;
  reading.stamp = clock.time;
  reading.urgent = false;
  reading.event.clear();
  reading.event_detail.clear();
  // Where the engine draws noise by the sensor's key, the sensor's own numbers have another.
  Rng rng(seed_, has_noise ? sensor.key ^ kOwnDraws : sensor.key, tick);
  const InstanceView view(building, *entries_[sample.index].live, clock, &sensor);
  sensor.sensor->read(view, hits, rng, reading);
  if (has_noise) sensor.latest = with_noise(sensor.noise, reading, Rng(seed_, sensor.key, tick));
  const bool steady = !sensor.on_demand() && sensor.sensor->steady();
  sensor.activity.sampled(steady, steady && sensor.varies(), as_published(sensor));
  sensor.queried = sample.queried | view.queried();
  const bool light_twice = sample.queried.light && view.queried().light;
  sensor.queried.other = sensor.queried.other || light_twice || sample.ray_count > 0;
  if (sensor.queried.contacts) sensor.contacts_seen = contacts_revision(engines, sensor);
  if (sensor.queried.light) sensor.light_seen = engines.light.lit_revision();
}

void SensorSystem::publish(std::uint32_t index, Nanoseconds now, Snapshot& next) {
  SensorInstance& sensor = *entries_[index].sensor;
  if (!sensor.activity.published()) {
    sensor.activity.publish();
    sensor.latest.stamp = now;
    sensor.published = {std::make_shared<const Reading>(sensor.latest), nullptr};
    next.sensors.set(index, sensor.published);
  }
  repeat(index, next);
}

}  // namespace angen::sim
