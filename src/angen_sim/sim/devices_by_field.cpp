#include "sim/devices_by_field.h"

#include "plugin/view.h"
#include "sim/building.h"

namespace angen::sim {

namespace {

FoundDevice found_device(const Building& building, const LiveModel& live,
                         const DeviceInstance& device, std::size_t order) {
  const Pose pose = building.pose_of(live);
  return {&live, &device, pose, DeviceView::place_of(pose, *device.last), order};
}

}  // namespace

const DevicesByField::Having& DevicesByField::having(const Building& building,
                                                     const std::string& field) {
  const auto [at, is_new] = by_field_.try_emplace(field);
  Having& all = at->second;
  if (!is_new) return all;
  std::size_t order = 0;
  for (const auto& live : building.models()) {
    const bool fixed = building.engines().physics.mass(live->parts.links.at(0)) == 0.0;
    for (const DeviceInstance& device : live->devices) {
      if (!device.last || !device.last->find(field)) continue;
      (fixed ? all.fixed : all.movable).push_back(found_device(building, *live, device, order++));
    }
  }
  std::stable_sort(all.fixed.begin(), all.fixed.end(),
                   [](const FoundDevice& a, const FoundDevice& b) { return a.low() < b.low(); });
  for (const FoundDevice& each : all.fixed) {
    all.tallest = std::max(all.tallest, each.high() - each.low());
  }
  return all;
}

std::vector<FoundDevice> DevicesByField::find(const Building& building, const std::string& field,
                                              const Eigen::AlignedBox3d& within) {
  const Having& all = having(building, field);
  std::vector<FoundDevice> in_box;
  in_box.reserve(all.fixed.size() + all.movable.size());
  const auto add = [&](const FoundDevice& device) {
    if (within.contains(device.pose.position) || within.contains(device.place)) {
      in_box.push_back(device);
    }
  };
  const auto lower =
      std::lower_bound(all.fixed.begin(), all.fixed.end(), within.min().z() - all.tallest,
                       [](const FoundDevice& t, double z) { return t.low() < z; });
  for (auto at = lower; at != all.fixed.end() && at->low() <= within.max().z(); ++at) {
    add(*at);
  }
  for (const FoundDevice& each : all.movable) {
    add(found_device(building, *each.live, *each.device, each.order));
  }
  std::sort(in_box.begin(), in_box.end(),
            [](const FoundDevice& a, const FoundDevice& b) { return a.order < b.order; });
  return in_box;
}

}  // namespace angen::sim
