// The part of DueSensors for leaps: which ticks sensors need, and their publications in
// those that are skipped.
#include <algorithm>

#include "sim/due_sensors.h"

namespace angen::sim {

namespace {

constexpr Nanoseconds kForecast = 10 * kSecond;  // noise is known at most this far ahead

}  // namespace

/// The first sample at or before `until` that may have an event; else kForever.
Nanoseconds DueSensors::next_possible_event(SensorInstance& sensor, Clock clock,
                                            Nanoseconds until) const {
  NoiseForecast& forecast = sensor.forecast;
  if (forecast.possible_event_at > clock.time) return forecast.possible_event_at;
  const Schedule& schedule = sensor.schedule;
  Nanoseconds after = std::max(clock.time, forecast.no_event_until);
  if (forecast.no_event_probability >= 1.0) {
    if (forecast.next_event > until) return kForever;
    after = std::max(after, forecast.next_event - schedule.sample - clock.step);
  }
  Nanoseconds due = schedule.next(after);
  for (Nanoseconds at = schedule.tick_of(due); at <= until;
       at = schedule.tick_of(due += schedule.sample)) {
    if (has_no_event(sensor, {at, clock.step})) continue;
    forecast.possible_event_at = at;
    return at;
  }
  forecast.no_event_until = std::max(forecast.no_event_until, until);
  return kForever;
}

/// The sample up to which the noise of a lazy sensor need not be checked again.
Nanoseconds DueSensors::next_check(SensorInstance& sensor, Clock clock) const {
  const Nanoseconds until = (clock.time / kForecast + 1) * kForecast;
  if (sensor.forecast.no_event_probability >= 1.0) {
    return sensor.forecast.next_event == kForever
               ? kForever
               : next_possible_event(sensor, clock, kForever - 1);
  }
  return std::min(next_possible_event(sensor, clock, until), until);
}

std::int64_t DueSensors::next_tick(Building& building, Clock clock, std::int64_t tick) {
  if (outdated_) list(building, clock.time);
  const auto stop_before = [&](Nanoseconds sample) {
    tick = std::min(tick, sample / clock.step - 1);  // the tick that ends with it
  };
  const std::int64_t here = clock.time / clock.step;
  stop_before(std::max(building.engines().next_light(), clock.time + clock.step));
  if (tick <= here) return here;
  for (const SensorScheduler::Group& group : scheduler_.groups()) {
    if (!group.idle.empty()) activate_changed(building.engines(), group);
  }
  for (std::uint32_t index = 0; index < entries_.size(); ++index) {
    const Entry& entry = entries_[index];
    SensorInstance& sensor = *entry.sensor;
    if (!sensor.error.empty() || scheduler_.is_idle(index)) continue;
    const bool needed = sensor.on_demand()
                            ? requested_.has(sensor.kind, sensor.name)
                            : !(sensor.activity.skips() && unchanged(building.engines(), entry));
    if (needed) stop_before(sensor.schedule.next_sample(clock.time));
    if (tick <= here) return here;
  }
  tick = std::min(tick, (clock.time + kForecast) / clock.step);
  meter_.rest.sensors += meter_.watch.lap();
  for (const Entry& entry : entries_) {
    if (!entry.sensor->activity.lazy()) continue;
    const Nanoseconds event = next_possible_event(*entry.sensor, clock, tick * clock.step);
    entry.sensor->cost += meter_.watch.lap();
    if (event != kForever) stop_before(event);
  }
  return tick;
}

void DueSensors::skip_to(Clock clock, std::int64_t tick, Snapshot& next) {
  const Nanoseconds to = tick * clock.step;
  std::uint64_t readings = next.counts.readings;
  const Schedule* last = nullptr;
  std::uint64_t each = 0;
  for (const Entry& entry : entries_) {
    const SensorInstance& sensor = *entry.sensor;
    if (sensor.on_demand() || !sensor.error.empty()) continue;
    if (last == nullptr || !(*last == sensor.schedule)) {  // mostly many have the same
      last = &sensor.schedule;
      each = static_cast<std::uint64_t>(last->publications(to) - last->publications(clock.time));
    }
    readings += each;
  }
  next.new_readings.clear();
  next.counts.readings = readings;
  scheduler_.requeue(to);
  meter_.rest.sensors += meter_.watch.lap();
}

}  // namespace angen::sim
