#include "sim/acting.h"

#include <algorithm>

namespace angen::sim {

namespace {

constexpr Nanoseconds kReportPeriod = kSecond / 50;

// What fell asleep in the last tick was awake in it.
bool is_idle(const LiveModel& live, const DeviceInstance& device, InstanceView::Clock clock) {
  return clock.time < device.idle_until && live.awake_at < clock.time / clock.step - 1;
}

}  // namespace

void Acting::list(Building& building) {
  list_is_old_ = false;
  parts_.clear();
  to_report_.clear();
  for (auto& live : building.models()) {
    for (DeviceInstance& device : live->devices) {
      if (device.to_report) to_report_.push_back(static_cast<std::uint32_t>(parts_.size()));
      parts_.push_back({live.get(), &device});
    }
  }
  busy_.clear();
  alarms_ = {};
  is_busy_.assign(parts_.size(), 0);
  rouse_all();
}

void Acting::rouse_all() {
  for (std::uint32_t i = 0; i < parts_.size(); ++i) rouse(i);
}

void Acting::rouse(std::uint32_t index) {
  if (is_busy_[index] != 0) return;
  is_busy_[index] = 1;
  busy_.push_back(index);
}

void Acting::rouse_due(Nanoseconds now) {
  while (!alarms_.empty() && alarms_.top().time <= now) {
    rouse(alarms_.top().index);
    alarms_.pop();
  }
  if (!std::is_sorted(busy_.begin(), busy_.end())) std::sort(busy_.begin(), busy_.end());
}

void Acting::rest(std::uint32_t index) {
  is_busy_[index] = 0;
  const Nanoseconds until = parts_[index].device->idle_until;
  if (until < kForever) alarms_.push({until, index});
}

void Acting::act(Building& building, InstanceView::Clock clock, std::vector<Event>& events) {
  if (list_is_old_) list(building);
  rouse_due(clock.time);
  told_.clear();
  lights_changed_ = false;
  bool reports_added = false;
  std::size_t kept = 0;
  for (const std::uint32_t i : busy_) {
    DeviceInstance& device = *parts_[i].device;
    LiveModel& live = *parts_[i].live;
    if (is_idle(live, device, clock)) {
      rest(i);
      continue;
    }
    busy_[kept++] = i;
    meter_.rest.devices += meter_.watch.lap();
    device.catch_up(clock.time, clock.step);
    const InstanceView view(building, live, clock);
    InstanceOutputs outputs(building.stage(), live, device, clock.time, events);
    device.device->update(view, outputs);
    device.updated = clock.time;
    device.idle_until = device.device->idle_until(view);
    if (!device.to_report) {
      device.to_report = reports_added = true;
      to_report_.push_back(i);
    }
    if (outputs.told() || !device.last) told_.push_back(i);
    lights_changed_ = lights_changed_ || outputs.lights_changed();
    device.cost += meter_.watch.lap();
  }
  busy_.resize(kept);
  if (reports_added) std::sort(to_report_.begin(), to_report_.end());
  meter_.rest.devices += meter_.watch.lap();
}

std::int64_t Acting::next_tick(Building& building, InstanceView::Clock clock) {
  if (list_is_old_) list(building);
  Nanoseconds first = kForever - clock.step;
  for (const std::uint32_t i : busy_) {
    if (!is_idle(*parts_[i].live, *parts_[i].device, clock)) return clock.time / clock.step;
    first = std::min(first, parts_[i].device->idle_until);
  }
  if (!alarms_.empty()) first = std::min(first, alarms_.top().time);
  std::int64_t tick = (first + clock.step - 1) / clock.step;
  if (!to_report_.empty()) {  // the next report is at the end of the tick before
    const Nanoseconds report = (clock.time / kReportPeriod + 1) * kReportPeriod;
    tick = std::min(tick, (report + clock.step - 1) / clock.step - 1);
  }
  return tick;
}

void Acting::note_awake(Building& building, std::int64_t tick) {
  awake_.clear();
  building.stage().physics.list_awake(awake_);
  for (const physics::LinkId link : awake_) {
    LiveModel& live = *building.owner(link).model;
    if (live.awake_at == tick) continue;
    live.awake_at = tick;
    for (std::uint32_t i = 0; i < live.devices.size(); ++i) rouse(live.first_device + i);
  }
}

void Acting::report(Building& building, InstanceView::Clock clock, Snapshot& next) {
  const bool all = clock.time % kReportPeriod < clock.step;
  for (const std::uint32_t index : all ? to_report_ : told_) {
    DeviceInstance& device = *parts_[index].device;
    device.device->report(InstanceView(building, *parts_[index].live, clock), device.scratch);
    device.cost += meter_.watch.lap();
    if (all) device.to_report = false;
    if (device.last && device.last->same_values(device.scratch)) continue;
    if (!device.last || !device.last->same_names(device.scratch)) building.forget_tellers();
    device.scratch.stamp = clock.time;
    device.last = std::make_shared<const Reading>(device.scratch);
    building.stage().note_told();
    next.devices.set(index, device.last);
    next.new_states.push_back(index);
  }
  if (all) to_report_.clear();
  meter_.rest.devices += meter_.watch.lap();
}

}  // namespace angen::sim
