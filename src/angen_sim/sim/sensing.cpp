#include "sim/sensing.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace angen::sim {

namespace {

constexpr int kMostStances = 256;  // of one sensor that are remembered

bool publishes(const SensorInstance& sensor, InstanceView::Clock clock) {
  return !sensor.told.reading ||
         sensor.rhythm.last_publication(clock.time) > clock.time - clock.step;
}

/// Whether it is where it was at its last look; else what it measured there is void.
bool stands_still(SensorInstance& sensor, const InstanceView& view) {
  if (!sensor.link_moves) return true;
  const Pose pose = view.pose();
  if (pose == sensor.seen_from) return true;
  sensor.seen_from = pose;
  sensor.looks.clear();
  return false;
}

}  // namespace

void Sensing::look(Building& building, InstanceView::Clock clock, std::int64_t tick,
                   Snapshot& next) {
  if (schedule_is_old_) schedule(building, clock.time - clock.step);
  Stage& stage = building.stage();
  if (collect_due(clock.time)) {
    looking_.clear();
    rays_.clear();
    meter_.rest.sensors += meter_.watch.lap();
    for (const std::uint32_t index : due_) {
      if (!keeps_calm(stage, index, clock.time, next)) visit(building, index, clock, next);
      if (!meter_.on) continue;
      watched_[index].sensor->cost += meter_.watch.lap();
    }
    const auto shared = static_cast<std::ptrdiff_t>(next.new_readings.size());
    cast(stage);
    for (const Looking& looking : looking_) read(building, looking, clock, tick, next);
    std::inplace_merge(next.new_readings.begin(), next.new_readings.begin() + shared,
                       next.new_readings.end());
  }
  stage.sights.pass();
  meter_.rest.sensors += meter_.watch.lap();
}

void Sensing::cast(Stage& stage) {
  if (rays_.empty()) return;
  stage.rays.commit();
  hits_.resize(rays_.size());
  stage.rays.cast(rays_.data(), hits_.data(), rays_.size());
  const Nanoseconds spent = meter_.watch.lap();
  if (spent == 0) return;
  const auto all = static_cast<Nanoseconds>(rays_.size());
  for (const Looking& looking : looking_) {  // each sensor pays for its rays
    watched_[looking.index].sensor->cost +=
        spent * static_cast<Nanoseconds>(looking.ray_count) / all;
  }
}

void Sensing::schedule(Building& building, Nanoseconds now) {
  schedule_is_old_ = false;
  watched_.clear();
  calm_.clear();
  groups_.clear();
  std::map<std::pair<Nanoseconds, Nanoseconds>, std::uint32_t> known;  // by due time and period
  for (auto& live : building.models()) {
    for (SensorInstance& sensor : live->sensors) {
      const std::pair<Nanoseconds, Nanoseconds> key(sensor.rhythm.next(now), sensor.rhythm.sample);
      const auto count = static_cast<std::uint32_t>(groups_.size());
      const auto [at, is_new] = known.emplace(key, count);
      if (is_new) groups_.emplace_back();
      groups_[at->second].push_back(static_cast<std::uint32_t>(watched_.size()));
      watched_.push_back({live.get(), &sensor});
    }
  }
  calm_.resize(watched_.size());
  requeue(now);
}

void Sensing::requeue(Nanoseconds now) {
  queue_ = {};
  for (std::uint32_t i = 0; i < groups_.size(); ++i) {
    queue_.push({watched_[groups_[i].front()].sensor->rhythm.next(now), i});
  }
}

bool Sensing::collect_due(Nanoseconds now) {
  due_.clear();
  while (!queue_.empty() && queue_.top().due <= now) {
    const std::uint32_t index = queue_.top().index;
    const std::vector<std::uint32_t>& group = groups_[index];
    queue_.pop();
    const auto middle = static_cast<std::ptrdiff_t>(due_.size());
    due_.insert(due_.end(), group.begin(), group.end());
    std::inplace_merge(due_.begin(), due_.begin() + middle, due_.end());
    queue_.push({watched_[group.front()].sensor->rhythm.next(now), index});
  }
  return !due_.empty();
}

bool Sensing::keeps_calm(const Stage& stage, std::uint32_t index, Nanoseconds now, Snapshot& next) {
  const Calm& calm = calm_[index];
  if (calm.view == UINT32_MAX) return false;
  if (stage.sights.stirred(calm.view, calm.seen)) {
    calm_[index] = {};
    return false;
  }
  if (!quiet(calm.key, calm.quiet_chance, now, calm.rhythm.step)) return false;
  if (calm.rhythm.last_publication(now) > now - calm.rhythm.step) repeat(index, next);
  return true;
}

void Sensing::calm_down(std::uint32_t index) {
  const SensorInstance& sensor = *watched_[index].sensor;
  if (sensor.asks_more || sensor.link_moves || !(sensor.published || sensor.echoes)) return;
  if (sensor.looks.size() != 1 || !sensor.looks.front()) return;
  calm_[index] = {sensor.looks.front()->view.number(), sensor.seen, sensor.rhythm, sensor.key,
                  sensor.echoes ? sensor.quiet_chance : 1.0};
}

/// Whether the sensor, for which nothing has changed, needs no look now; then it has published.
bool Sensing::goes_on(std::uint32_t index, InstanceView::Clock clock, Snapshot& next) {
  SensorInstance& sensor = *watched_[index].sensor;
  if (sensor.rest == Rest::kSame) {
    if (publishes(sensor, clock)) publish(index, clock.time, next);
    return true;
  }
  if (sensor.rest != Rest::kNoise || !sensor.told.reading) return false;
  if (!sensor.echoes) {
    if (sensor.calm <= sensor.sensor->memory()) return false;
    sensor.quiet_chance = sensor.sensor->quiet_chance();
  }
  if (!quiet(sensor.key, sensor.quiet_chance, clock.time, clock.step)) return false;
  if (!sensor.echoes) {
    sensor.told.echo = sensor.sensor->echo();
    if (!sensor.told.echo) return false;
    sensor.echoes = true;
    next.sensors.set(index, sensor.told);
  }
  if (publishes(sensor, clock)) repeat(index, next);
  return true;
}

/// Its echo stood for it up to now.
void Sensing::resume(std::uint32_t index, InstanceView::Clock clock, Snapshot& next) {
  SensorInstance& sensor = *watched_[index].sensor;
  sensor.echoes = false;
  calm_[index] = {};
  const Nanoseconds last = sensor.rhythm.last_look(clock.time - clock.step);
  sensor.sensor->resume(last, draws_at(sensor.rhythm, last, seed_, sensor.key));
  if (publishes(sensor, clock)) return;
  sensor.told = {next.reading(index), nullptr};  // there may be another echo before the next
  next.sensors.set(index, sensor.told);
}

void Sensing::repeat(std::uint32_t index, Snapshot& next) {
  next.new_readings.push_back(index);
  ++next.counts.readings;
}

void Sensing::visit(Building& building, std::uint32_t index, InstanceView::Clock clock,
                    Snapshot& next) {
  SensorInstance& sensor = *watched_[index].sensor;
  if (sensor.rest == Rest::kBusy && sensor.sensor->on_demand()) {
    if (!demand_.has(sensor.kind, sensor.name)) return;
  } else if (undisturbed(building.stage(), sensor)) {
    ++sensor.calm;
    if (goes_on(index, clock, next)) {
      calm_down(index);
      return;
    }
  } else {
    sensor.calm = 0;
  }
  if (sensor.echoes) resume(index, clock, next);
  aim(building, index, clock);
}

bool Sensing::undisturbed(const Stage& stage, const SensorInstance& sensor) {
  if ((sensor.asks_more || sensor.link_moves) && stage.changed() >= sensor.seen) return false;
  if (sensor.asks_devices && stage.told() >= sensor.seen) return false;
  return std::none_of(sensor.looks.begin(), sensor.looks.end(), [&](const auto& look) {
    return look != nullptr && look->view.stirred(sensor.seen);
  });
}

void Sensing::aim(Building& building, std::uint32_t index, InstanceView::Clock clock) {
  Stage& stage = building.stage();
  SensorInstance& sensor = *watched_[index].sensor;
  const InstanceView view(building, *watched_[index].live, clock, &sensor);
  Looking looking{index, nullptr, false, false, rays_.size(), 0};
  const int stance = sensor.sensor->stance(view);
  if (stance >= 0 && stance < kMostStances && stands_still(sensor, view)) {
    if (sensor.looks.size() <= static_cast<std::size_t>(stance)) sensor.looks.resize(stance + 1);
    std::unique_ptr<Look>& look = sensor.looks[stance];
    if (!look) {
      RayBatch rays;
      sensor.sensor->aim(view, rays);
      stage.rays.commit();
      look = std::make_unique<Look>(std::move(rays), stage);
    } else if (look->view.take_altered()) {
      stage.rays.commit();
      look->measure(stage);
    }
    looking.look = look.get();
  } else {
    sensor.sensor->aim(view, rays_);
    looking.ray_count = rays_.size() - looking.first_ray;
  }
  looking.asked_more = view.asked_more();
  looking.asked_devices = view.asked_devices();
  looking_.push_back(looking);
}

/// `same`: they are those of the look before.
Hits Sensing::hits_of(Stage& stage, const Looking& looking, bool& same) {
  if (looking.look == nullptr) return {hits_.data() + looking.first_ray, looking.ray_count};
  same = looking.look->look(stage, parted_, gaze_hits_);
  return {gaze_hits_.data(), gaze_hits_.size()};
}

void Sensing::read(Building& building, const Looking& looking, InstanceView::Clock clock,
                   std::int64_t tick, Snapshot& next) {
  SensorInstance& sensor = *watched_[looking.index].sensor;
  Stage& stage = building.stage();
  bool same = false;
  const Hits hits = hits_of(stage, looking, same);
  sensor.seen = stage.sights.now() + 1;
  Reading& reading = sensor.scratch;
  if (!same || sensor.rest != Rest::kSame || sensor.asks_more) {
    reading.stamp = clock.time;
    reading.urgent = false;
    reading.event.clear();
    reading.event_detail.clear();
    Rng rng(seed_, sensor.key, tick);
    const InstanceView view(building, *watched_[looking.index].live, clock, &sensor);
    sensor.sensor->read(view, hits, rng, reading);
    sensor.rest = sensor.sensor->on_demand() ? Rest::kBusy : sensor.sensor->rest();
    sensor.asks_more = looking.asked_more || view.asked_more() || looking.ray_count > 0;
    sensor.asks_devices = looking.asked_devices || view.asked_devices();
    sensor.published = sensor.published && sensor.rest == Rest::kSame && !reading.urgent &&
                       reading.event == sensor.told.reading->event &&
                       reading.same_values(*sensor.told.reading);
    if (!reading.event.empty()) {
      next.events.push_back(
          {clock.time, sensor.name, sensor.kind, reading.event, reading.event_detail});
    }
  }
  if (publishes(sensor, clock) || (reading.urgent && !sensor.published)) {
    publish(looking.index, clock.time, next);
  }
  sensor.cost += meter_.watch.lap();
}

void Sensing::publish(std::uint32_t index, Nanoseconds now, Snapshot& next) {
  SensorInstance& sensor = *watched_[index].sensor;
  if (!sensor.published) {
    sensor.published = true;
    sensor.scratch.stamp = now;
    sensor.told = {std::make_shared<const Reading>(sensor.scratch), nullptr};
    next.sensors.set(index, sensor.told);
  }
  repeat(index, next);
}

}  // namespace angen::sim
