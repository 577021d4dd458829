#include "sim/building.h"

#include <algorithm>
#include <map>
#include <utility>

namespace angen::sim {

namespace {

Error taken(const Source& source, const std::string& what, const std::string& name,
            const std::string& by) {
  return Error(source, what + " '" + name + "' exists already, in model '" + by +
                           "'; names of a kind must differ");
}

template <class Instance>
std::string key_of(const Instance& instance) {
  return instance.kind + "/" + instance.name;
}

}  // namespace

Building::Building(const desc::World& world, std::uint64_t seed, std::shared_ptr<Catalog> catalog)
    : world_(world), seed_(seed), catalog_(std::move(catalog)) {
  raise_stage();
  for (const desc::Plugin& plugin : world_.plugins) {
    try {
      catalog_->library(plugin.filename);
    } catch (const Error& error) {
      throw Error(plugin.source, error.diagnostics().front().message);
    }
  }
  for (const desc::Model& model : world_.models) build(model, nullptr, 0);
}

void Building::raise_stage() {
  stage_ = std::make_unique<Stage>(world_, seed_);
  owners_.clear();
  lights_.clear();
  for (const desc::Light& light : world_.lights) {
    lights_.push_back({light, stage_->add_light(light, light.pose)});
  }
}

void Building::note_revision() {
  ++revision_;
  tellers_.clear();
}

Pose Building::pose_of(const LiveModel& live) const {
  const Pose first = stage_->physics.link(live.parts.links.at(0)).pose;
  return first * live.desc->links.front().pose.inverse();
}

const Building::Tellers& Building::all_tellers(const std::string& field) const {
  const auto [at, is_new] = tellers_.try_emplace(field);
  Tellers& all = at->second;
  if (!is_new) return all;
  std::size_t order = 0;
  for (const auto& live : models_) {
    const bool fixed = stage_->physics.mass(live->parts.links.at(0)) == 0.0;
    for (const DeviceInstance& device : live->devices) {
      if (!device.last || !device.last->find(field)) continue;
      (fixed ? all.fixed : all.movable).push_back({live.get(), &device, pose_of(*live), order++});
    }
  }
  std::stable_sort(all.fixed.begin(), all.fixed.end(), [](const Teller& a, const Teller& b) {
    return a.pose.position.z() < b.pose.position.z();
  });
  return all;
}

std::vector<Building::Teller> Building::tellers(const std::string& field,
                                                const Eigen::AlignedBox3d& within) const {
  const Tellers& all = all_tellers(field);
  std::vector<Teller> found;
  const auto add = [&](const Teller& teller) {
    if (within.contains(teller.pose.position)) found.push_back(teller);
  };
  const auto lower =
      std::lower_bound(all.fixed.begin(), all.fixed.end(), within.min().z(),
                       [](const Teller& t, double z) { return t.pose.position.z() < z; });
  for (auto at = lower; at != all.fixed.end() && at->pose.position.z() <= within.max().z(); ++at) {
    add(*at);
  }
  for (Teller teller : all.movable) {
    teller.pose = pose_of(*teller.live);
    add(teller);
  }
  std::sort(found.begin(), found.end(),
            [](const Teller& a, const Teller& b) { return a.order < b.order; });
  return found;
}

LiveModel* Building::find(const std::string& model) const {
  const auto at = by_name_.find(model);
  return at == by_name_.end() ? nullptr : at->second;
}

std::vector<std::string> Building::model_names() const {
  std::vector<std::string> names;
  for (const auto& live : models_) names.push_back(live->desc->name);
  return names;
}

void Building::check_sensor_name(const SensorInstance& sensor) const {
  const auto other = sensors_.find(key_of(sensor));
  if (other == sensors_.end()) return;
  throw taken(sensor.desc->source, sensor.kind, sensor.name, other->second->desc->name);
}

void Building::check_names(const LiveModel& live) const {
  if (find(live.desc->name) != nullptr) {
    throw Error(live.desc->source,
                "model '" + live.desc->name + "' exists already; choose another name");
  }
  for (const DeviceInstance& device : live.devices) {
    const auto other = devices_.find(key_of(device));
    if (other == devices_.end()) continue;
    throw taken(live.desc->source, device.kind, device.name, other->second->desc->name);
  }
  for (const SensorInstance& sensor : live.sensors) check_sensor_name(sensor);
}

void Building::list_names(LiveModel& live) {
  by_name_[live.desc->name] = &live;
  for (const DeviceInstance& device : live.devices) devices_[key_of(device)] = &live;
  for (const SensorInstance& sensor : live.sensors) sensors_[key_of(sensor)] = &live;
}

void Building::strike_names(const LiveModel& live) {
  by_name_.erase(live.desc->name);
  for (const DeviceInstance& device : live.devices) devices_.erase(key_of(device));
  for (const SensorInstance& sensor : live.sensors) sensors_.erase(key_of(sensor));
}

/// The sensor's model is on the stage.
void Building::start(SensorInstance& sensor, Nanoseconds now) const {
  sensor.rhythm.start = now;
  sensor.rhythm.step = world_.physics.step;
  for (const std::string& name : sensor.collisions) {
    sensor.touching.push_back(stage_->physics.collision(name));
  }
}

void Building::build(desc::Model model, const std::vector<SensorInstance>* attached,
                     Nanoseconds now) {
  auto live = std::make_unique<LiveModel>();
  live->desc = std::make_shared<const desc::Model>(std::move(model));
  make_instances(*live, world_.plugins, world_.gravity, *catalog_, warnings_);
  for (std::size_t i = 0; attached != nullptr && i < attached->size(); ++i) {
    const SensorInstance& old = (*attached)[i];
    live->sensors.push_back(
        make_sensor(*live, old.link, old.desc, old.name, world_.gravity, *catalog_));
    live->sensors.back().attached = true;
  }
  check_names(*live);
  live->parts = stage_->add(*live->desc);
  for (SensorInstance& sensor : live->sensors) start(sensor, now);
  for (DeviceInstance& device : live->devices) device.updated = now - world_.physics.step;
  for (std::uint32_t i = 0; i < live->parts.links.size(); ++i) {
    const std::uint32_t index = live->parts.links[i].index;
    if (owners_.size() <= index) owners_.resize(index + 1);
    owners_[index] = {live.get(), i};
  }
  list_names(*live);
  models_.push_back(std::move(live));
  note_revision();
}

void Building::add(desc::Model model, Nanoseconds now) { build(std::move(model), nullptr, now); }

void Building::attach(const desc::Sensor& sensor, const std::string& link, Nanoseconds now) {
  const std::size_t split = link.find("::");
  if (split == std::string::npos) {
    throw Error("'" + link + "' is not the name of a link; links are written model::link");
  }
  LiveModel* live = find(link.substr(0, split));
  if (live == nullptr) {
    throw Error("no model named '" + link.substr(0, split) + "'; known are " +
                join_names(model_names()));
  }
  std::vector<std::string> names;
  for (const desc::Link& l : live->desc->links) names.push_back(l.name);
  const auto at = std::find(names.begin(), names.end(), link.substr(split + 2));
  if (at == names.end()) {
    throw Error("model '" + live->desc->name + "' has no link '" + link.substr(split + 2) +
                "'; known are " + join_names(names));
  }
  if (sensor.plugin.empty()) throw Error(sensor.source, "the sensor has no <plugin>");
  SensorInstance instance = make_sensor(*live, static_cast<std::uint32_t>(at - names.begin()),
                                        std::make_shared<const desc::Sensor>(sensor), sensor.name,
                                        world_.gravity, *catalog_);
  check_sensor_name(instance);
  instance.attached = true;
  start(instance, now);
  sensors_[key_of(instance)] = live;
  live->sensors.push_back(std::move(instance));
  note_revision();
}

void Building::erase(const std::string& name) {
  const auto model = std::find_if(models_.begin(), models_.end(),
                                  [&](const auto& live) { return live->desc->name == name; });
  if (model != models_.end()) {
    stage_->remove((*model)->parts);
    strike_names(**model);
    models_.erase(model);
    note_revision();
    return;
  }
  for (auto& live : models_) {
    for (auto sensor = live->sensors.begin(); sensor != live->sensors.end(); ++sensor) {
      if (sensor->name != name) continue;
      if (!sensor->attached) {
        throw Error("sensor '" + name + "' is a part of model '" + live->desc->name +
                    "'; delete that");
      }
      sensors_.erase(key_of(*sensor));
      live->sensors.erase(sensor);
      note_revision();
      return;
    }
  }
  throw Error("no model or attached sensor named '" + name + "'; known models are " +
              join_names(model_names()));
}

void Building::reset(Nanoseconds now) {
  std::vector<std::unique_ptr<LiveModel>> old;
  old.swap(models_);
  for (auto* names : {&by_name_, &devices_, &sensors_}) names->clear();
  for (const auto& live : old) {
    for (SensorInstance& sensor : live->sensors) {  // these stand on the stage
      sensor.looks.clear();
      sensor.light.reset();
    }
  }
  raise_stage();
  for (const auto& live : old) {
    std::vector<SensorInstance> attached;
    for (SensorInstance& sensor : live->sensors) {
      if (sensor.attached) attached.push_back(std::move(sensor));
    }
    build(*live->desc, &attached, now);
  }
  warnings_.clear();
}

std::shared_ptr<const Structure> Building::structure() {
  auto all = std::make_shared<Structure>();
  all->revision = revision_;
  for (const WorldLight& world_light : lights_) {
    LightEntry entry;
    entry.name = world_light.light.name;
    entry.light = world_light.light;
    all->lights.push_back(std::move(entry));
  }
  for (const auto& live : models_) {
    const auto m = static_cast<std::uint32_t>(all->models.size());
    const desc::Model& model = *live->desc;
    all->models.push_back(live->desc);
    live->first_link = static_cast<std::uint32_t>(all->links.size());
    live->first_joint = static_cast<std::uint32_t>(all->joints.size());
    live->first_device = static_cast<std::uint32_t>(all->devices.size());
    live->first_sensor = static_cast<std::uint32_t>(all->sensors.size());
    live->first_light = static_cast<std::uint32_t>(all->lights.size());
    for (std::uint32_t i = 0; i < model.links.size(); ++i) {
      all->links.push_back({model.name + "::" + model.links[i].name, m, i, !model.is_static});
      for (const desc::Light& light : model.links[i].lights) {
        all->lights.push_back({model.name + "::" + light.name, m, live->first_link + i, light});
      }
    }
    for (std::uint32_t i = 0; i < model.joints.size(); ++i) {
      all->joints.push_back({model.name + "::" + model.joints[i].name, m, i});
    }
    for (const DeviceInstance& device : live->devices) {
      all->devices.push_back({device.kind, device.name, m});
    }
    for (const SensorInstance& s : live->sensors) {
      all->sensors.push_back({s.kind, s.name, m, live->first_link + s.link, s.pose, s.topic,
                              s.frame, s.key, s.rhythm.publish, s.rhythm, s.attached,
                              s.sensor->on_demand(), s.desc});
    }
  }
  return all;
}

std::vector<double> Building::light_levels() const {
  std::vector<double> levels(lights_.size(), 1.0);
  for (const auto& live : models_) {
    for (const Parts::Lamp& lamp : live->parts.lamps) levels.push_back(lamp.level);
  }
  return levels;
}

std::vector<std::string> Building::take_warnings() { return std::exchange(warnings_, {}); }

std::vector<SavedPlugin> Building::saved_plugins(Nanoseconds now, Nanoseconds step) {
  std::vector<SavedPlugin> saved;
  for (const auto& live : models_) {
    // Devices may share a plug-in's element: then it has the parameters of all.
    std::map<std::string, std::pair<Element, bool>> elements;
    for (DeviceInstance& device : live->devices) {
      device.catch_up(now, step);
      SavedParams params;
      device.device->save(params);
      auto& [element, changed] = elements[*device.element.attribute("filename")];
      if (element.name.empty()) element = device.element;
      params.write_to(element);
      changed = changed || !(params == device.started_with);
    }
    for (auto& [file, saved_element] : elements) {
      if (saved_element.second) saved.push_back({live->desc->name, std::move(saved_element.first)});
    }
  }
  return saved;
}

}  // namespace angen::sim
