#include "sim/acting.h"

#include <algorithm>

namespace angen::sim {

namespace {

constexpr Nanoseconds kReportPeriod = kSecond / 50;

}  // namespace

void Acting::act(Building& building, InstanceView::Clock clock, std::vector<Event>& events) {
  told_.clear();
  lights_changed_ = false;
  for (auto& live : building.models()) {
    for (DeviceInstance& device : live->devices) {
      const InstanceView view(building.stage(), *live, clock);
      InstanceOutputs outputs(building.stage(), *live, device, clock.time, events);
      device.device->update(view, outputs);
      if (outputs.told()) told_.push_back(&device);
      lights_changed_ = lights_changed_ || outputs.lights_changed();
    }
  }
}

void Acting::report(Building& building, InstanceView::Clock clock, Snapshot& next) {
  const bool all = clock.time % kReportPeriod < clock.step;
  if (!all && told_.empty()) return;
  for (auto& live : building.models()) {
    for (std::size_t i = 0; i < live->devices.size(); ++i) {
      DeviceInstance& device = live->devices[i];
      const bool told = std::find(told_.begin(), told_.end(), &device) != told_.end();
      if (!all && !told && device.last) continue;
      device.device->report(InstanceView(building.stage(), *live, clock), device.scratch);
      if (device.last && device.last->same_values(device.scratch)) continue;
      device.scratch.stamp = clock.time;
      device.last = std::make_shared<const Reading>(device.scratch);
      const auto index = live->first_device + static_cast<std::uint32_t>(i);
      next.devices.set(index, device.last);
      next.new_states.push_back(index);
    }
  }
}

}  // namespace angen::sim
