// The structure of snapshots, and the state of saved worlds.
#include <map>
#include <utility>

#include "sim/building.h"

namespace angen::sim {

/// The plug-ins of the world's libraries and of all devices, one a kind.
std::vector<std::shared_ptr<const Plugin>> Building::device_plugins() {
  std::map<std::string, std::shared_ptr<const Plugin>> kinds;
  for (const desc::Plugin& plugin : plugins_) {
    for (const auto& each : catalog_->library(plugin.filename)) {
      kinds.emplace(each->kind().name, each);
    }
  }
  for (const LiveModel* live : with_devices()) {
    for (const DeviceInstance& device : live->devices) kinds.emplace(device.kind, device.plugin);
  }
  std::vector<std::shared_ptr<const Plugin>> all;
  for (auto& [name, plugin] : kinds) all.push_back(std::move(plugin));
  return all;
}

Numbering Building::numbering(std::size_t model) const {
  if (model > 0) return numbering_after(*models_[model - 1]);
  Numbering first;
  first.light = static_cast<std::uint32_t>(lights_.size());
  return first;
}

/// Puts the model behind those that are there, and numbers its parts.
void Building::append(LiveModel& live, Structure& all) const {
  const auto number = static_cast<std::uint32_t>(all.models.size());
  const desc::Model& model = *live.desc;
  all.models.push_back(live.desc);
  live.first_link = static_cast<std::uint32_t>(all.links.size());
  live.first_joint = static_cast<std::uint32_t>(all.joints.size());
  live.first_device = static_cast<std::uint32_t>(all.devices.size());
  live.first_sensor = static_cast<std::uint32_t>(all.sensors.size());
  live.first_light = static_cast<std::uint32_t>(all.lights.size());
  for (std::uint32_t i = 0; i < model.links.size(); ++i) {
    all.links.push_back({model.name + "::" + model.links[i].name, number, i, !model.is_static});
    for (const desc::Light& light : model.links[i].lights) {
      all.lights.push_back({model.name + "::" + light.name, number, live.first_link + i, light});
    }
  }
  for (std::uint32_t i = 0; i < model.joints.size(); ++i) {
    all.joints.push_back({model.name + "::" + model.joints[i].name, number, i});
  }
  for (const DeviceInstance& device : live.devices) {
    all.devices.push_back({device, number, UINT32_MAX});
  }
  for (const SensorInstance& sensor : live.sensors) {
    all.sensors.push_back({sensor, number, live.first_link + sensor.link});
  }
}

std::shared_ptr<const Structure> Building::structure() {
  const std::size_t from = structure_ ? renumbered_from_ : 0;
  const Numbering kept = numbering(from);
  auto all = from > 0 ? std::make_shared<Structure>(*structure_) : std::make_shared<Structure>();
  all->revision = revision_;
  all->physics = physics_;
  all->gravity = gravity_;
  all->storeys = home_.storeys();
  all->home = home_.derived(*this);
  all->device_plugins = device_plugins();
  if (from > 0) {
    all->models.resize(from);
    all->links.truncate(kept.link);
    all->joints.truncate(kept.joint);
    all->devices.truncate(kept.device);
    all->sensors.truncate(kept.sensor);
    all->lights.truncate(kept.light);
  } else {
    for (const WorldLight& own : lights_) {
      all->lights.push_back({own.light().name, UINT32_MAX, UINT32_MAX, own.light()});
    }
  }
  for (std::size_t i = from; i < models_.size(); ++i) append(*models_[i], *all);
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    lights_[i].live->first_light = i;
    lights_[i].live->first_device = static_cast<std::uint32_t>(all->devices.size());
    for (const DeviceInstance& device : lights_[i].live->devices) {
      all->devices.push_back({device, UINT32_MAX, i});
    }
  }
  renumbered_from_ = models_.size();
  structure_ = all;
  return all;
}

std::vector<double> Building::light_levels() const {
  std::vector<double> levels;
  for (const WorldLight& own : lights_) {
    levels.push_back(own.live->devices.empty() ? 1.0 : own.live->parts.lamps[0].level);
  }
  for (const auto& live : models_) {
    for (const Parts::Lamp& lamp : live->parts.lamps) levels.push_back(lamp.level);
  }
  return levels;
}

std::vector<SavedPlugin> Building::saved_plugins(Nanoseconds now, Nanoseconds step) {
  std::vector<SavedPlugin> saved;
  for (const auto& live : models_) {
    // Devices may share a plug-in's element: then it has the parameters of all.
    struct Shared {
      Element element;
      SavedParams params;
      bool changed = false;
    };
    std::map<std::string, Shared> elements;
    for (DeviceInstance& device : live->devices) {
      if (device.own_light >= 0) continue;
      SavedParams params = device.started_with;
      if (device.error.empty()) {
        device.catch_up(now, step);
        params = {};
        device.device->save(params);
      }
      Shared& shared = elements[*device.element.attribute("filename")];
      if (shared.element.name.empty()) shared.element = device.element;
      shared.params.add(params);
      shared.changed = shared.changed || !(params == device.started_with);
    }
    for (auto& [file, shared] : elements) {
      if (!shared.changed) continue;
      shared.params.write_to(shared.element);
      saved.push_back({live->desc->name, std::move(shared.element)});
    }
  }
  return saved;
}

std::vector<SavedLight> Building::saved_lights() const {
  std::vector<SavedLight> saved;
  for (const LiveModel* live : with_devices()) {
    const std::string sdf = live->is_light ? lights_[live->first_light].sdf : "";
    SavedLight light{live->first_light, sdf, {}};
    bool has = sdf.empty();
    for (const DeviceInstance& device : live->devices) {
      if (device.own_light < 0 || !device.error.empty()) continue;
      SavedParams params;
      device.device->save(params);
      if (params == device.started_with && sdf.empty()) continue;
      light.light = live->first_light + static_cast<std::uint32_t>(device.own_light);
      light.lamp = {};
      params.write_to(light.lamp);
      saved.push_back(light);
      has = true;
    }
    if (!has) saved.push_back(light);
  }
  return saved;
}

std::vector<LiveModel*> Building::with_devices() const {
  std::vector<LiveModel*> all;
  for (const auto& live : models_) all.push_back(live.get());
  for (const WorldLight& own : lights_) all.push_back(own.live.get());
  return all;
}

std::vector<ChangedModel> Building::changed_models() const {
  std::vector<ChangedModel> changed;
  for (std::uint32_t i = 0; i < models_.size(); ++i) {
    if (models_[i]->read != models_[i]->desc) changed.push_back({i, models_[i]->read});
  }
  return changed;
}

}  // namespace angen::sim
