#include "sim/registry.h"

#include "core/lists.h"

namespace angen::sim {

namespace {

Error taken(const Source& source, const std::string& what, const std::string& name,
            const LiveModel& by) {
  const std::string where =
      by.is_light ? "as a light of the world" : "in model '" + by.desc->name + "'";
  return Error(source,
               what + " '" + name + "' exists already, " + where + "; names of a kind must differ");
}

}  // namespace

LiveModel* Registry::find(const ByName& all, const std::string& name) {
  const auto at = all.find(name);
  return at == all.end() ? nullptr : at->second;
}

LiveModel* Registry::model(const std::string& name) const { return find(models_, name); }

LiveModel* Registry::with_device(const std::string& kind, const std::string& name) const {
  return find(devices_, kind + "/" + name);
}

LiveModel* Registry::with_sensor(const std::string& kind, const std::string& name) const {
  return find(sensors_, kind + "/" + name);
}

std::vector<LiveModel*> Registry::with_devices(const std::string& name) const {
  const auto at = with_device_.find(name);
  return at == with_device_.end() ? std::vector<LiveModel*>() : at->second;
}

void Registry::check(const SensorInstance& sensor) const {
  if (const LiveModel* other = with_sensor(sensor.kind, sensor.name)) {
    throw taken(sensor.desc->source, sensor.kind, sensor.name, *other);
  }
}

void Registry::check(const LiveModel& live) const {
  if (model(live.desc->name) != nullptr) {
    throw Error(live.desc->source,
                "model '" + live.desc->name + "' exists already; choose another name");
  }
  for (const DeviceInstance& device : live.devices) {
    if (const LiveModel* other = with_device(device.kind, device.name)) {
      throw taken(live.desc->source, device.kind, device.name, *other);
    }
  }
  for (const SensorInstance& sensor : live.sensors) check(sensor);
}

void Registry::add(LiveModel& live) {
  if (!live.is_light) models_[live.desc->name] = &live;
  for (const DeviceInstance& device : live.devices) {
    devices_[full_name(device)] = &live;
    std::vector<LiveModel*>& with = with_device_[device.name];
    if (with.empty() || with.back() != &live) with.push_back(&live);
  }
  for (const SensorInstance& sensor : live.sensors) add(sensor, live);
}

void Registry::remove(const LiveModel& live) {
  if (!live.is_light) models_.erase(live.desc->name);
  for (const DeviceInstance& device : live.devices) {
    devices_.erase(full_name(device));
    std::vector<LiveModel*>& with = with_device_[device.name];
    erase_if(with, [&](const auto& each) { return each == &live; });
    if (with.empty()) with_device_.erase(device.name);
  }
  for (const SensorInstance& sensor : live.sensors) remove(sensor);
}

}  // namespace angen::sim
