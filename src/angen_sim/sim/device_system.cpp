#include "sim/device_system.h"

#include <algorithm>

#include "plugin/declared.h"
#include "plugin/outputs.h"
#include "plugin/reading.h"
#include "sim/command_queue.h"
#include "sim/guard.h"
#include "sim/view.h"

namespace angen::sim {

namespace {

// A body that fell asleep in the last tick was awake in it.
bool is_idle(const LiveModel& live, const DeviceInstance& device, Clock clock) {
  if (!device.error.empty()) return true;
  return clock.time < device.idle_until && live.awake_at < clock.time / clock.step - 1;
}

}  // namespace

void DeviceSystem::list(Building& building) {
  outdated_ = false;
  entries_.clear();
  to_report_.clear();
  for (LiveModel* live : building.with_devices()) {
    for (DeviceInstance& device : live->devices) {
      if (device.to_report) to_report_.push_back(static_cast<std::uint32_t>(entries_.size()));
      entries_.push_back({live, &device});
    }
  }
  active_.clear();
  timers_ = {};
  is_active_.assign(entries_.size(), 0);
  activate_all();
}

void DeviceSystem::activate_all() {
  for (std::uint32_t i = 0; i < entries_.size(); ++i) activate(i);
}

void DeviceSystem::activate(std::uint32_t index) {
  if (is_active_[index] != 0) return;
  is_active_[index] = 1;
  active_.push_back(index);
}

void DeviceSystem::activate_due(Nanoseconds now) {
  while (!timers_.empty() && timers_.top().time <= now) {
    activate(timers_.top().index);
    timers_.pop();
  }
  if (!std::is_sorted(active_.begin(), active_.end())) std::sort(active_.begin(), active_.end());
}

void DeviceSystem::make_idle(std::uint32_t index) {
  is_active_[index] = 0;
  const Nanoseconds until = entries_[index].device->idle_until;
  if (until < kForever) timers_.push({until, index});
}

void DeviceSystem::fail(DeviceInstance& device, const std::string& error, Nanoseconds now,
                        std::vector<Event>& events) {
  device.error = error;
  device.idle_until = kForever;
  events.push_back({now, device.name, device.kind, "failed", error});
}

void DeviceSystem::update(Building& building, Clock clock, Nanoseconds last,
                          std::vector<Event>& events) {
  if (outdated_) list(building);
  activate_due(clock.time);
  had_event_.clear();
  lights_changed_ = false;
  bool reports_added = false;
  std::size_t kept = 0;
  for (const std::uint32_t i : active_) {
    DeviceInstance& device = *entries_[i].device;
    LiveModel& live = *entries_[i].live;
    if (is_idle(live, device, clock)) {
      make_idle(i);
      continue;
    }
    active_[kept++] = i;
    meter_.rest.devices += meter_.watch.lap();
    const bool long_steps = device.device->takes_long_steps();
    const Clock own{clock.time, long_steps ? last : clock.step};
    const InstanceView view(building, live, own);
    InstanceOutputs outputs(building, live, device, clock.time, events, commands_);
    const std::string thrown = thrown_by([&] {
      device.catch_up(own.time, own.step);
      device.device->update(view, outputs);
      device.updated = clock.time;
      device.idle_until = device.device->idle_until(view);
    });
    if (!thrown.empty()) fail(device, thrown, clock.time, events);
    if (!device.to_report) {
      device.to_report = reports_added = true;
      to_report_.push_back(i);
    }
    if (outputs.had_event() || !device.last || !thrown.empty()) had_event_.push_back(i);
    lights_changed_ = lights_changed_ || outputs.lights_changed();
    device.cost += meter_.watch.lap();
  }
  active_.resize(kept);
  execute_commands(building, clock, events);
  if (reports_added) std::sort(to_report_.begin(), to_report_.end());
  meter_.rest.devices += meter_.watch.lap();
}

void DeviceSystem::execute_commands(Building& building, Clock clock, std::vector<Event>& events) {
  if (commands_.empty()) return;
  for (const ToDevice& each : commands_) {
    const Outcome outcome = to_device(each, building, clock);
    if (!outcome.ok)
      events.push_back({clock.time, each.name, each.kind, "rejected", outcome.message});
  }
  commands_.clear();
  activate_all();
}

std::int64_t DeviceSystem::next_end(Building& building, Clock clock, bool moving) {
  if (outdated_) list(building);
  Nanoseconds first = kForever - clock.step;
  for (const std::uint32_t i : active_) {
    if (moving && entries_[i].device->device->takes_long_steps()) continue;
    if (!is_idle(*entries_[i].live, *entries_[i].device, clock)) return clock.time / clock.step + 1;
    first = std::min(first, entries_[i].device->idle_until);
  }
  if (!timers_.empty()) first = std::min(first, timers_.top().time);
  const std::int64_t end = (first + clock.step - 1) / clock.step + (moving ? 0 : 1);
  if (to_report_.empty()) return end;
  const Nanoseconds report = (clock.time / kReportPeriod + 1) * kReportPeriod;
  return std::min(end, (report + clock.step - 1) / clock.step);
}

void DeviceSystem::place_limbs(Engines& engines, const LiveModel& live, DeviceInstance& device) {
  if (device.body < 0) return;
  const auto link = static_cast<std::size_t>(device.body);
  const std::size_t count = live.desc->links[link].anatomy.limbs.size();
  std::vector<Pose> limbs(count);
  device.device->pose_limbs(limbs);
  limbs.resize(count);
  if (limbs.empty() || (device.limbs && *device.limbs == limbs)) return;
  device.limbs = std::make_shared<const std::vector<Pose>>(std::move(limbs));
  engines.place_limbs(live.parts.links[link], device.limbs);
}

void DeviceSystem::note_awake(const LiveModel& live) {
  for (std::uint32_t i = 0; i < live.devices.size(); ++i) activate(live.first_device + i);
}

void DeviceSystem::report(Building& building, Clock clock, Snapshot& next) {
  const bool all = clock.time % kReportPeriod < clock.step;
  for (const std::uint32_t index : all ? to_report_ : had_event_) {
    DeviceInstance& device = *entries_[index].device;
    const LiveModel& live = *entries_[index].live;
    if (device.error.empty()) {
      const std::string thrown = thrown_by([&] {
        device.device->report(InstanceView(building, live, clock), device.scratch);
        check_new_fields(device.plugin->kind(), device.scratch, device.checked_fields);
        place_limbs(building.engines(), live, device);
      });
      if (!thrown.empty()) fail(device, thrown, clock.time, next.events);
    }
    if (!device.error.empty()) device.scratch.set(kErrorField, device.error);
    next.limbs.set(index, device.limbs);
    device.cost += meter_.watch.lap();
    if (all) device.to_report = false;
    if (device.last && device.last->same_values(device.scratch)) continue;
    if (!device.last || !device.last->same_names(device.scratch)) {
      device.changes = {};
      building.forget_fields();
    }
    device.scratch.stamp = clock.time;
    device.last = std::make_shared<const Reading>(device.scratch);
    device.offset = DeviceView::place_of(Pose(), *device.last);
    if (!live.is_light) {
      building.note_state(live, device, building.pose_of(live), building.engines().movers.now());
    }
    next.devices.set(index, device.last);
    next.new_states.push_back(index);
  }
  if (all) to_report_.clear();
  meter_.rest.devices += meter_.watch.lap();
}

}  // namespace angen::sim
