#include "sim/sensor_system.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "plugin/declared.h"
#include "sim/guard.h"
#include "sim/view.h"

namespace angen::sim {

namespace {

constexpr int kMaxRaySets = 256;  // cached ray sets of one sensor
const std::uint64_t kOwnDraws = hash_bytes("own draws");

bool publishes(const SensorInstance& sensor, Clock clock) {
  return !sensor.published.reading ||
         sensor.schedule.last_publication(clock.time) > clock.time - clock.step;
}

/// Whether it has not moved since its last sample; otherwise drops its cached scans.
bool stands_still(const Engines& engines, const LiveModel& live, SensorInstance& sensor) {
  if (!sensor.link_moves) return true;
  const Pose pose = pose_of(engines, live, sensor);
  if (pose == sensor.seen_from) return true;
  sensor.seen_from = pose;
  sensor.scans.clear();
  return false;
}

/// Whether the latest reading has nothing that the last published one has not.
bool as_published(const SensorInstance& sensor) {
  const Reading& reading = sensor.latest;
  return sensor.up_to_date && !reading.urgent && reading.event == sensor.published.reading->event &&
         reading.same_values(*sensor.published.reading);
}

}  // namespace

void SensorSystem::sample(Building& building, Clock clock, std::int64_t tick, Snapshot& next) {
  Engines& engines = building.engines();
  engines.advance_light(clock.time);
  samples_.clear();
  rays_.clear();
  const std::vector<std::uint32_t>& due = due_.collect(building, clock);
  meter_.rest.sensors += meter_.watch.lap();
  for (const std::uint32_t index : due) {
    visit(building, index, clock, next);
    if (meter_.on) due_[index].sensor->cost += meter_.watch.lap();
  }
  cast(engines);
  const std::size_t repeated = next.new_readings.size();
  for (const Sample& sample : samples_) {
    read(building, sample, clock, tick, next);
    due_[sample.index].sensor->cost += meter_.watch.lap();
  }
  merge_from(next.new_readings, repeated);
  due_.publish_idle(engines, clock, next);
  engines.movers.advance();
  meter_.rest.sensors += meter_.watch.lap();
}

void SensorSystem::visit(Building& building, std::uint32_t index, Clock clock, Snapshot& next) {
  const DueSensors::Visit visit = due_.visit(building.engines(), index, clock, next);
  if (visit == DueSensors::Visit::kSample) begin_sample(building, index, clock, next);
  if (visit == DueSensors::Visit::kRepeat && publishes(*due_[index].sensor, clock)) {
    repeat(index, next);
  }
}

void SensorSystem::begin_sample(Building& building, std::uint32_t index, Clock clock,
                                Snapshot& next) {
  end_idle(index, clock, next);
  const std::size_t others = rays_.size();
  const std::string thrown = thrown_by([&] { aim(building, index, clock); });
  if (thrown.empty()) return;
  rays_.resize(others);
  fail(index, thrown, clock.time, next);
}

void SensorSystem::aim(Building& building, std::uint32_t index, Clock clock) {
  Engines& engines = building.engines();
  SensorInstance& sensor = *due_[index].sensor;
  const InstanceView view(building, *due_[index].live, clock, &sensor);
  Sample sample{index, nullptr, {}, rays_.size(), 0};
  const int ray_set = sensor.sensor->ray_set(view);
  const bool still = stands_still(engines, *due_[index].live, sensor);
  if (still && ray_set >= 0 && ray_set < kMaxRaySets) {
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

void SensorSystem::cast(Engines& engines) {
  if (rays_.empty()) return;
  engines.rays.commit();
  hits_.resize(rays_.size());
  engines.rays.cast(rays_.data(), hits_.data(), rays_.size());
  const Nanoseconds spent = meter_.watch.lap();
  if (spent == 0) return;
  const auto all = static_cast<Nanoseconds>(rays_.size());
  for (const Sample& sample : samples_) {  // each sensor pays for its rays
    due_[sample.index].sensor->cost += spent * static_cast<Nanoseconds>(sample.ray_count) / all;
  }
}

void SensorSystem::read(Building& building, const Sample& sample, Clock clock, std::int64_t tick,
                        Snapshot& next) {
  SensorInstance& sensor = *due_[sample.index].sensor;
  Engines& engines = building.engines();
  Hits hits{hits_.data() + sample.first_ray, sample.ray_count};
  sensor.seen = engines.movers.now() + 1;
  if (sample.scan != nullptr) {
    const bool differ = sample.scan->cast(engines, split_, cached_hits_);
    if (!differ && !sample.queried.any() && due_.stays(sample.index, clock)) {
      if (publishes(sensor, clock)) repeat(sample.index, next);
      return;
    }
    hits = {cached_hits_.data(), cached_hits_.size()};
  }
  const std::string thrown = thrown_by(
      [&] { note_sampled(engines, sample, measure(building, sample, hits, clock, tick), clock); });
  if (!thrown.empty()) {
    fail(sample.index, thrown, clock.time, next);
    return;
  }
  const Reading& reading = sensor.latest;
  if (!reading.event.empty()) {
    next.events.push_back(
        {clock.time, sensor.name, sensor.kind, reading.event, reading.event_detail});
  }
  if (publishes(sensor, clock) || (reading.urgent && !sensor.up_to_date)) {
    publish(sample.index, clock.time, next);
  }
  due_.begin_idle(sample.index, clock, next);
}

/// The sensor's reading, with its noise.
Queried SensorSystem::measure(Building& building, const Sample& sample, Hits hits, Clock clock,
                              std::int64_t tick) const {
  SensorInstance& sensor = *due_[sample.index].sensor;
  const bool has_noise = !sensor.noise.empty();
  Reading& reading = has_noise ? sensor.clean : sensor.latest;
  reading.stamp = clock.time;
  reading.urgent = false;
  reading.event.clear();
  reading.event_detail.clear();
  // If the engine draws noise by the sensor's key, the sensor's own numbers have another key.
  Rng rng(seed_, has_noise ? sensor.key ^ kOwnDraws : sensor.key, tick);
  const InstanceView view(building, *due_[sample.index].live, clock, &sensor);
  sensor.sensor->read(view, hits, rng, reading);
  check_new_fields(sensor.plugin->kind(), reading, sensor.checked_fields);
  if (has_noise) sensor.latest = with_noise(sensor.noise, reading, Rng(seed_, sensor.key, tick));
  return view.queried();
}

/// Notes on which values its next samples depend.
void SensorSystem::note_sampled(const Engines& engines, const Sample& sample,
                                const Queried& queried, Clock clock) {
  SensorInstance& sensor = *due_[sample.index].sensor;
  sensor.lasts = due_.note_sampled(sample.index, clock) && !sensor.lazy_reading();
  sensor.up_to_date = sensor.lasts && as_published(sensor);
  sensor.queried = sample.queried | queried;
  const bool light_twice = sample.queried.light && queried.light;
  sensor.queried.other =
      sensor.queried.other || light_twice || (sample.ray_count > 0 && sensor.near == nullptr);
  if (sensor.queried.contacts) sensor.contacts_seen = contacts_revision(engines, sensor);
  if (sensor.queried.light) sensor.light_seen = engines.light.lit_revision();
}

void SensorSystem::publish(std::uint32_t index, Nanoseconds now, Snapshot& next) {
  SensorInstance& sensor = *due_[index].sensor;
  if (!sensor.up_to_date) {
    sensor.up_to_date = true;
    sensor.latest.stamp = now;
    sensor.published = {std::make_shared<const Reading>(sensor.latest), nullptr};
    next.sensors.set(index, sensor.published);
  }
  repeat(index, next);
}

void SensorSystem::repeat(std::uint32_t index, Snapshot& next) {
  next.new_readings.push_back(index);
  ++next.counts.readings;
}

/// Ends the time in which the sensor repeated its reading, or a lazy one replaced its samples.
void SensorSystem::end_idle(std::uint32_t index, Clock clock, Snapshot& next) {
  SensorInstance& sensor = *due_[index].sensor;
  if (!std::exchange(sensor.idle, false) || !sensor.published.lazy) return;
  const Nanoseconds last = sensor.schedule.last_sample(clock.time - clock.step);
  if (last > sensor.latest.stamp) {
    sensor.sensor->skip(last, draws_at(sensor.schedule, last, seed_, sensor.key));
  }
  if (!publishes(sensor, clock)) sensor.published.reading = next.reading(index);
  sensor.published.lazy = nullptr;  // it may be lazy again before the next publication
  next.sensors.set(index, sensor.published);
}

/// The sensor has thrown `error`: its last reading stays, with a field for it.
void SensorSystem::fail(std::uint32_t index, const std::string& error, Nanoseconds now,
                        Snapshot& next) {
  SensorInstance& sensor = *due_[index].sensor;
  due_.note_failing(index);
  sensor.error = error;
  sensor.scans.clear();
  sensor.idle = false;
  sensor.latest.stamp = now;
  sensor.latest.set(kErrorField, error);
  sensor.published = {std::make_shared<const Reading>(sensor.latest), nullptr};
  next.sensors.set(index, sensor.published);
  next.events.push_back({now, sensor.name, sensor.kind, "failed", error});
}

}  // namespace angen::sim
