#include "sim/devices_by_field.h"

#include "plugin/view.h"
#include "sim/building.h"

namespace angen::sim {

FoundDevice::FoundDevice(const LiveModel& model, const DeviceInstance& found, const Pose& where)
    : live(&model), device(&found), pose(where), place(where * found.offset) {}

Heights FoundDevice::heights() const {
  return Heights{pose.position.z(), pose.position.z()} | Heights{place.z(), place.z()};
}

DevicesByField::Having& DevicesByField::having(const Building& building, const std::string& field) {
  const auto [at, is_new] = by_field_.try_emplace(field);
  Having& all = at->second;
  if (!is_new) return all;
  for (const auto& live : building.models()) {
    const bool fixed = building.engines().physics.mass(live->parts.links.at(0)) == 0.0;
    for (const DeviceInstance& device : live->devices) {
      if (!device.last || !device.last->find(field)) continue;
      FoundDevice found(*live, device, building.pose_of(*live));
      found.order = all.devices.size();
      found.fixed = fixed;
      all.devices.push_back(found);
      all.tallest = std::max(all.tallest, device.changes.around.high - device.changes.around.low);
    }
  }
  std::stable_sort(all.devices.begin(), all.devices.end(),
                   [](const FoundDevice& a, const FoundDevice& b) {
                     return a.device->changes.around.low < b.device->changes.around.low;
                   });
  return all;
}

std::vector<const FoundDevice*> DevicesByField::find(const Building& building,
                                                     const std::string& field,
                                                     const Eigen::AlignedBox3d& within) {
  std::vector<const FoundDevice*> in_box;
  Having& all = having(building, field);
  auto at = std::lower_bound(
      all.devices.begin(), all.devices.end(), within.min().z() - all.tallest,
      [](const FoundDevice& found, double z) { return found.device->changes.around.low < z; });
  for (; at != all.devices.end() && at->device->changes.around.low <= within.max().z(); ++at) {
    if (!at->fixed) at->pose = building.pose_of(*at->live);
    at->place = at->pose * at->device->offset;
    if (within.contains(at->pose.position) || within.contains(at->place)) in_box.push_back(&*at);
  }
  std::sort(in_box.begin(), in_box.end(),
            [](const FoundDevice* a, const FoundDevice* b) { return a->order < b->order; });
  return in_box;
}

}  // namespace angen::sim
