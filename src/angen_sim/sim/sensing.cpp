#include "sim/sensing.h"

#include <algorithm>
#include <limits>

namespace angen::sim {

void Sensing::look(Building& building, InstanceView::Clock clock, std::int64_t tick,
                   Snapshot& next) {
  if (clock.time < earliest_) return;
  building.stage().rays.commit();
  aim(building, clock);
  hits_.resize(rays_.size());
  building.stage().rays.cast(rays_.data(), hits_.data(), rays_.size());
  for (const Due& due : due_) read(building, due, clock, tick, next);
}

void Sensing::aim(Building& building, InstanceView::Clock clock) {
  due_.clear();
  rays_.clear();
  earliest_ = std::numeric_limits<Nanoseconds>::max();
  for (auto& live : building.models()) {
    for (std::size_t i = 0; i < live->sensors.size(); ++i) {
      SensorInstance& sensor = live->sensors[i];
      if (clock.time >= sensor.next_sample()) {
        if (!sensor.sensor->on_demand() || demand_.has(sensor.kind, sensor.name)) {
          const std::size_t first = rays_.size();
          sensor.sensor->aim(InstanceView(building.stage(), *live, clock, &sensor), rays_);
          due_.push_back({live.get(), i, first, rays_.size() - first});
        }
        while (sensor.next_sample() <= clock.time) ++sensor.samples;
      }
      earliest_ = std::min(earliest_, sensor.next_sample());
    }
  }
}

void Sensing::read(Building& building, const Due& due, InstanceView::Clock clock, std::int64_t tick,
                   Snapshot& next) {
  SensorInstance& sensor = due.live->sensors[due.sensor];
  Reading& reading = sensor.scratch;
  reading.stamp = clock.time;
  reading.urgent = false;
  reading.event.clear();
  reading.event_detail.clear();
  Rng rng(seed_, sensor.key, tick);
  sensor.sensor->read(InstanceView(building.stage(), *due.live, clock, &sensor),
                      Hits{hits_.data() + due.first_ray, due.ray_count}, rng, reading);
  if (!reading.event.empty()) {
    next.events.push_back(
        {clock.time, sensor.name, sensor.kind, reading.event, reading.event_detail});
  }
  const bool periodic = clock.time >= sensor.next_publish();
  if (!periodic && !reading.urgent) return;
  while (sensor.next_publish() <= clock.time) ++sensor.published;
  sensor.last = std::make_shared<const Reading>(reading);
  const auto index = due.live->first_sensor + static_cast<std::uint32_t>(due.sensor);
  next.sensors.set(index, sensor.last);
  next.new_readings.push_back(index);
  ++next.counts.readings;
}

}  // namespace angen::sim
