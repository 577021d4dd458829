#include "sim/sensing.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace angen::sim {

namespace {

constexpr int kMostStances = 256;  // of one sensor that are remembered
constexpr std::uint32_t kNobody = UINT32_MAX;

/// What stands from `middle` on was added; both parts ascend.
void merge_from(std::vector<std::uint32_t>& list, std::size_t middle) {
  std::inplace_merge(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(middle), list.end());
}

bool publishes(const SensorInstance& sensor, InstanceView::Clock clock) {
  return !sensor.told.reading ||
         sensor.rhythm.last_publication(clock.time) > clock.time - clock.step;
}

Pose pose_of(const Stage& stage, const LiveModel& live, const SensorInstance& sensor) {
  return stage.physics.link(live.parts.links[sensor.link]).pose * sensor.pose;
}

/// Whether it is where it was at its last look; else what it measured there is void.
bool stands_still(const Stage& stage, const LiveModel& live, SensorInstance& sensor) {
  if (!sensor.link_moves) return true;
  const Pose pose = pose_of(stage, live, sensor);
  if (pose == sensor.seen_from) return true;
  sensor.seen_from = pose;
  sensor.looks.clear();
  return false;
}

std::uint64_t contacts_revision(const Stage& stage, const SensorInstance& sensor) {
  std::uint64_t sum = 0;
  for (const physics::CollisionId collision : sensor.touching) {
    sum += stage.physics.contacts_revision(collision);
  }
  return sum;
}

bool sees_the_same_light(const Stage& stage, const SensorInstance& sensor) {
  if (stage.light.lit_revision() != sensor.light_seen) return false;
  if (stage.light.dark() || stage.changed() < sensor.seen) return true;
  // Walls and doors lead light past them, wherever they are.
  if (!sensor.light || stage.standing_changed() >= sensor.seen) return false;
  return !sensor.light->view.stirred(sensor.light->looked);
}

/// Whether it would be told the same of what it asked for besides rays.
bool is_told_the_same(const Stage& stage, const LiveModel& live, const SensorInstance& sensor) {
  const Asked& asked = sensor.asked;
  const bool moved = stage.changed() >= sensor.seen;  // anything
  if (asked.other && moved) return false;
  if (asked.devices && stage.told() >= sensor.seen) return false;
  if (asked.light && !sees_the_same_light(stage, sensor)) return false;
  if (asked.contacts && contacts_revision(stage, sensor) != sensor.contacts_seen) return false;
  return !sensor.link_moves || !moved || pose_of(stage, live, sensor) == sensor.seen_from;
}

}  // namespace

void Sensing::look(Building& building, InstanceView::Clock clock, std::int64_t tick,
                   Snapshot& next) {
  if (schedule_is_old_) schedule(building, clock.time - clock.step);
  Stage& stage = building.stage();
  const std::vector<std::uint32_t>& groups = rota_.collect(clock.time);
  if (!groups.empty()) {
    for (const std::uint32_t group : groups) rouse(stage, rota_.group(group), clock);
    meter_.rest.sensors += meter_.watch.lap();
    visit_due(building, groups, clock, next);
    cast(stage);
    const std::size_t repeated = next.new_readings.size();
    for (const Looking& looking : looking_) read(building, looking, clock, tick, next);
    merge_from(next.new_readings, repeated);
    for (const std::uint32_t group : groups) go_on(rota_.group(group), stage, clock, next);
  }
  stage.sights.pass();
  meter_.rest.sensors += meter_.watch.lap();
}

void Sensing::visit_due(Building& building, const std::vector<std::uint32_t>& groups,
                        InstanceView::Clock clock, Snapshot& next) {
  due_.clear();
  for (const std::uint32_t group : groups) {
    const std::vector<std::uint32_t>& awake = rota_.group(group).awake;
    const std::size_t others = due_.size();
    due_.insert(due_.end(), awake.begin(), awake.end());
    merge_from(due_, others);
  }
  looking_.clear();
  rays_.clear();
  for (const std::uint32_t index : due_) {
    visit(building, index, clock, next);
    if (meter_.on) watched_[index].sensor->cost += meter_.watch.lap();
  }
}

/// What the calm ones do at a due time.
void Sensing::go_on(Rota::Group& group, const Stage& stage, InstanceView::Clock clock,
                    Snapshot& next) {
  if (group.publishes(clock.time)) {
    const std::size_t others = next.new_readings.size();
    next.new_readings.insert(next.new_readings.end(), group.calm.begin(), group.calm.end());
    merge_from(next.new_readings, others);
    next.counts.readings += group.calm.size();
  }
  rota_.shift(group);
  group.looked = stage.sights.now() + 1;
}

void Sensing::rouse(const Stage& stage, Rota::Group& group, InstanceView::Clock clock) {
  if (group.calm.empty()) return;
  rouse_stirred(stage, group);
  if (group.alarm <= clock.time) rouse_loud(group, clock);
  rota_.shift(group);
}

void Sensing::rouse_stirred(const Stage& stage, const Rota::Group& group) {
  stage.sights.each_stirred(group.looked, [&](std::uint32_t view) {
    const std::uint32_t index = view < watcher_of_.size() ? watcher_of_[view] : kNobody;
    if (index == kNobody || !rota_.is_calm(index)) return;
    if (&rota_.group(rota_.group_of(index)) != &group) return;
    if (stage.sights.stirred(view, group.looked)) rota_.rouse(index);
  });
}

/// Those whose noise may tell something now.
void Sensing::rouse_loud(Rota::Group& group, InstanceView::Clock clock) {
  group.alarm = kForever;
  for (const std::uint32_t index : group.calm) {
    if (alarms_[index] <= clock.time) {
      SensorInstance& sensor = *watched_[index].sensor;
      if (!quiet(sensor, clock)) {
        rota_.rouse(index);
        continue;
      }
      alarms_[index] = alarm_of(sensor, clock);
    }
    group.alarm = std::min(group.alarm, alarms_[index]);
  }
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
  watcher_of_.clear();
  std::vector<Rhythm> rhythms;
  for (auto& live : building.models()) {
    for (SensorInstance& sensor : live->sensors) {
      rhythms.push_back(sensor.rhythm);
      watched_.push_back({live.get(), &sensor});
    }
  }
  alarms_.assign(watched_.size(), kForever);
  rota_.assign(rhythms, now);
}

/// One that nothing but what stirs in its views can rouse is not visited until then.
void Sensing::calm_down(const Stage& stage, std::uint32_t index, InstanceView::Clock clock) {
  SensorInstance& sensor = *watched_[index].sensor;
  if (sensor.asked.any() || sensor.link_moves || !(sensor.published || sensor.echoes)) return;
  const auto known = [](const auto& look) { return look && look->view.number() != kNobody; };
  if (sensor.looks.empty() || !std::all_of(sensor.looks.begin(), sensor.looks.end(), known)) return;
  watcher_of_.resize(std::max(watcher_of_.size(), stage.sights.view_count()), kNobody);
  for (const auto& look : sensor.looks) watcher_of_[look->view.number()] = index;
  rota_.calm(index);
  Rota::Group& group = rota_.group(rota_.group_of(index));
  alarms_[index] = sensor.echoes ? alarm_of(sensor, clock) : kForever;
  group.alarm = std::min(group.alarm, alarms_[index]);
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
  if (!quiet(sensor, clock)) return false;
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
  } else if (undisturbed(building.stage(), watched_[index])) {
    ++sensor.calm;
    if (goes_on(index, clock, next)) {
      calm_down(building.stage(), index, clock);
      return;
    }
  } else {
    sensor.calm = 0;
  }
  if (sensor.echoes) resume(index, clock, next);
  aim(building, index, clock);
}

bool Sensing::undisturbed(const Stage& stage, const Watched& watched) {
  const SensorInstance& sensor = *watched.sensor;
  if ((sensor.asked.any() || sensor.link_moves) &&
      !is_told_the_same(stage, *watched.live, sensor)) {
    return false;
  }
  return std::none_of(sensor.looks.begin(), sensor.looks.end(), [&](const auto& look) {
    return look != nullptr && look->view.stirred(sensor.seen);
  });
}

void Sensing::aim(Building& building, std::uint32_t index, InstanceView::Clock clock) {
  Stage& stage = building.stage();
  SensorInstance& sensor = *watched_[index].sensor;
  const InstanceView view(building, *watched_[index].live, clock, &sensor);
  Looking looking{index, nullptr, {}, rays_.size(), 0};
  const int stance = sensor.sensor->stance(view);
  const bool still = stands_still(stage, *watched_[index].live, sensor);
  if (still && stance >= 0 && stance < kMostStances) {
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
  looking.asked = view.asked();
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
  if (!same || sensor.rest != Rest::kSame || sensor.asked.any()) {
    reading.stamp = clock.time;
    reading.urgent = false;
    reading.event.clear();
    reading.event_detail.clear();
    Rng rng(seed_, sensor.key, tick);
    const InstanceView view(building, *watched_[looking.index].live, clock, &sensor);
    sensor.sensor->read(view, hits, rng, reading);
    sensor.rest = sensor.sensor->on_demand() ? Rest::kBusy : sensor.sensor->rest();
    sensor.asked = looking.asked | view.asked();
    const bool light_twice = looking.asked.light && view.asked().light;
    sensor.asked.other = sensor.asked.other || light_twice || looking.ray_count > 0;
    if (sensor.asked.contacts) sensor.contacts_seen = contacts_revision(stage, sensor);
    if (sensor.asked.light) sensor.light_seen = stage.light.lit_revision();
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
