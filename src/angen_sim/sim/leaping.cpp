// The part of Sensing that lets time jump: what is due meanwhile, and what is left of it.
#include <algorithm>

#include "sim/sensing.h"

namespace angen::sim {

namespace {

constexpr Nanoseconds kFarthest = 10 * kSecond;  // that noise is looked ahead

}  // namespace

bool Sensing::may_be_passed_over(const Stage& stage, const Watched& watched) const {
  if (!undisturbed(stage, watched)) return false;
  const SensorInstance& sensor = *watched.sensor;
  if (sensor.rest == Rest::kSame) return sensor.published;
  return sensor.echoes;
}

/// The first look at or before `until` that may tell something because of its noise; else kForever.
Nanoseconds Sensing::first_loud(SensorInstance& sensor, InstanceView::Clock clock,
                                Nanoseconds until) const {
  if (sensor.loud_at > clock.time) return sensor.loud_at;
  const Rhythm& rhythm = sensor.rhythm;
  Nanoseconds due = rhythm.next(std::max(clock.time, sensor.quiet_until));
  for (Nanoseconds at = rhythm.tick_of(due); at <= until;
       at = rhythm.tick_of(due += rhythm.sample)) {
    if (quiet(sensor, {at, clock.step})) continue;
    sensor.loud_at = at;
    return at;
  }
  sensor.quiet_until = std::max(sensor.quiet_until, until);
  return kForever;
}

/// The look up to which the noise of one that echoes need not be asked again.
Nanoseconds Sensing::alarm_of(SensorInstance& sensor, InstanceView::Clock clock) const {
  const Nanoseconds until = (clock.time / kFarthest + 1) * kFarthest;
  return sensor.quiet_chance < 1.0 ? std::min(first_loud(sensor, clock, until), until) : kForever;
}

std::int64_t Sensing::next_tick(Building& building, InstanceView::Clock clock, std::int64_t tick) {
  if (schedule_is_old_) schedule(building, clock.time);
  const auto stop_before = [&](Nanoseconds look) {
    tick = std::min(tick, look / clock.step - 1);  // the tick that ends with it
  };
  const std::int64_t here = clock.time / clock.step;
  for (const Watched& watched : watched_) {
    SensorInstance& sensor = *watched.sensor;
    if (sensor.sensor->on_demand()) {
      if (demand_.has(sensor.kind, sensor.name)) stop_before(sensor.rhythm.next_look(clock.time));
    } else if (!may_be_passed_over(building.stage(), watched)) {
      stop_before(sensor.rhythm.next_look(clock.time));
    }
    if (tick <= here) return here;
  }
  tick = std::min(tick, (clock.time + kFarthest) / clock.step);
  meter_.rest.sensors += meter_.watch.lap();
  for (const Watched& watched : watched_) {
    if (!watched.sensor->echoes) continue;
    const Nanoseconds loud = first_loud(*watched.sensor, clock, tick * clock.step);
    watched.sensor->cost += meter_.watch.lap();
    if (loud != kForever) stop_before(loud);
  }
  return tick;
}

void Sensing::pass_over(InstanceView::Clock clock, std::int64_t tick, Snapshot& next) {
  const Nanoseconds to = tick * clock.step;
  std::uint64_t readings = next.counts.readings;
  for (const Watched& watched : watched_) {
    const SensorInstance& sensor = *watched.sensor;
    if (sensor.sensor->on_demand()) continue;
    readings += static_cast<std::uint64_t>(sensor.rhythm.publications(to) -
                                           sensor.rhythm.publications(clock.time));
  }
  next.new_readings.clear();
  next.counts.readings = readings;
  rota_.requeue(to);
  meter_.rest.sensors += meter_.watch.lap();
}

}  // namespace angen::sim
