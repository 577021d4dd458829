#include "sim/building.h"

#include <utility>

#include "core/alike.h"
#include "core/lists.h"
#include "core/named.h"
#include "core/nearest.h"
#include "core/text.h"
#include "sim/device_maker.h"

namespace angen::sim {

Building::Building(const desc::World& world, std::uint64_t seed, std::shared_ptr<Catalog> catalog)
    : world_(world),
      physics_(world.physics),
      gravity_(world.gravity),
      seed_(seed),
      catalog_(std::move(catalog)),
      faults_(seed),
      home_(world) {
  for (const desc::Light& light : world.lights) lights_.push_back(world_light(light, ""));
  make_engines();
  for (const desc::Plugin& plugin : world_.plugins) {
    try {
      catalog_->library(plugin.filename);
      plugins_.push_back(plugin);
    } catch (const Error& error) {
      const Error placed(plugin.source, error.diagnostics().front().message);
      for (const std::string& text : set_aside(placed, world_.customs)) warnings_.push_back(text);
    }
  }
  std::vector<const desc::Model*> all;
  for (const desc::Model& model : world_.models) all.push_back(&model);
  home_.find_storeys(*this, all);
  for (const desc::Model& model : world_.models) build(model, nullptr, 0);
  for (WorldLight& own : lights_) make_lamp(*own.live, 0);
}

void Building::make_engines() {
  engines_ = std::make_unique<Engines>(world_, seed_);
  engines_->physics.set(physics_, gravity_);
  owners_.clear();
  placed_.clear();
  pushes_.clear();
  for (WorldLight& own : lights_) put_light(own);
}

/// Parts of models before `first_model` keep their numbers.
void Building::note_change(std::size_t first_model) {
  ++revision_;
  renumbered_from_ = std::min(renumbered_from_, first_model);
  forget_fields();
}

std::size_t Building::number_of(const LiveModel& live) const {
  const auto at = std::find_if(models_.begin(), models_.end(),
                               [&](const auto& model) { return model.get() == &live; });
  return static_cast<std::size_t>(at - models_.begin());
}

Pose Building::pose_of(const LiveModel& live) const {
  const Pose first = engines_->physics.pose(live.parts.links.at(0));
  return first * live.desc->links.front().pose.inverse();
}

std::vector<const FoundDevice*> Building::find_devices(const std::string& field,
                                                       const Eigen::AlignedBox3d& within) const {
  return by_field_.find(*this, field, within);
}

std::optional<FoundDevice> Building::find_device(const std::string& field, const std::string& kind,
                                                 const std::string& name) const {
  const LiveModel* live = registry_.with_device(kind, name);
  if (live == nullptr || live->is_light) return std::nullopt;
  for (const DeviceInstance& device : live->devices) {
    if (device.kind != kind || device.name != name) continue;
    if (device.last && device.last->find(field)) return FoundDevice(*live, device, pose_of(*live));
  }
  return std::nullopt;
}

void Building::note_state(const LiveModel& live, DeviceInstance& device, const Pose& pose,
                          MoverIndex::Moment when) const {
  const Heights at = FoundDevice(live, device, pose).heights();
  if (engines_->states.note(*device.last, at, device.changes, when)) by_field_.clear();
}

void Building::note_states(LiveModel& live, MoverIndex::Moment when) const {
  if (live.devices.empty() || live.is_light) return;  // queries do not find the world's own lights
  const Pose pose = pose_of(live);
  for (DeviceInstance& device : live.devices) {
    if (device.last) note_state(live, device, pose, when);
  }
}

std::vector<Building::Target> Building::devices_named(const std::string& kind,
                                                      const std::string& name) const {
  const bool all = name == "all" && !kind.empty();
  std::vector<Target> targets;
  for (LiveModel* live : all ? with_devices() : registry_.with_devices(name)) {
    for (DeviceInstance& device : live->devices) {
      if (!kind.empty() && device.kind != kind) continue;
      if (all || device.name == name) targets.push_back({live, &device});
    }
  }
  return targets;
}

std::vector<std::string> Building::device_names(const std::string& kind) const {
  std::vector<std::string> names;
  for (const LiveModel* live : with_devices()) {
    for (const DeviceInstance& device : live->devices) {
      if (kind.empty()) names.push_back(full_name(device));
      if (device.kind == kind) names.push_back(device.name);
    }
  }
  return names;
}

std::vector<std::string> Building::names_to_delete() const {
  std::vector<std::string> names = model_names();
  for (const auto& live : models_) {
    for (const SensorInstance& sensor : live->sensors) {
      if (sensor.attached) names.push_back(sensor.name);
    }
  }
  return names;
}

std::vector<std::string> Building::model_names() const {
  std::vector<std::string> names;
  for (const auto& live : models_) names.push_back(live->desc->name);
  return names;
}

/// The sensor's model is in the engines.
void Building::start(SensorInstance& sensor, Nanoseconds now) const {
  sensor.schedule.start = now;
  sensor.schedule.step = world_.physics.step;
  for (const std::string& name : sensor.collisions) {
    sensor.touching.push_back(engines_->physics.collision(name));
  }
}

void Building::build(desc::Model model, const std::vector<SensorInstance>* attached,
                     Nanoseconds now) {
  auto live = std::make_unique<LiveModel>();
  if (world_.customs.sets_aside) model.customs = world_.customs;
  live->storeys = home_.storeys();
  live->desc = live->read = std::make_shared<const desc::Model>(std::move(model));
  make_instances(*live, plugins_, *catalog_, warnings_);
  for (std::size_t i = 0; attached != nullptr && i < attached->size(); ++i) {
    const SensorInstance& old = (*attached)[i];
    live->sensors.push_back(make_sensor(*live, old.link, old.desc, old.name, *catalog_, warnings_));
    live->sensors.back().attached = true;
  }
  drop_taken_lamps(*live);
  registry_.check(*live);
  live->parts = engines_->add(*live->desc);
  for (SensorInstance& sensor : live->sensors) start(sensor, now);
  for (DeviceInstance& device : live->devices) device.updated = now - world_.physics.step;
  for (std::uint32_t i = 0; i < live->parts.links.size(); ++i) {
    const std::uint32_t index = live->parts.links[i].index;
    if (owners_.size() <= index) owners_.resize(index + 1);
    owners_[index] = {live.get(), i};
  }
  registry_.add(*live);
  home_.note(*live);
  models_.push_back(std::move(live));
  note_change(models_.size() - 1);
}

void Building::add(desc::Model model, Nanoseconds now) {
  const std::size_t before = warnings_.size();
  const bool has_storeys = BuildingHome::may_have_storeys(model);
  if (has_storeys) home_.find_storeys(*this, {&model});
  for (const Diagnostic& warning : model.warnings) warnings_.push_back(warning.text());
  try {
    build(std::move(model), nullptr, now);
  } catch (...) {
    warnings_.resize(before);  // drops warnings of a model that is not there
    if (has_storeys) home_.find_storeys(*this, {});
    throw;
  }
}

void Building::attach(const desc::Sensor& sensor, const std::string& link, Nanoseconds now) {
  const std::size_t split = link.find("::");
  if (split == std::string::npos) {
    throw Error("'" + printable(link) +
                "' is not the name of a link; links are written model::link");
  }
  LiveModel* live = find(link.substr(0, split));
  if (live == nullptr) {
    throw Error("no model named '" + printable(link.substr(0, split)) + "'; " +
                did_you_mean(link.substr(0, split), model_names()));
  }
  const std::vector<desc::Link>& links = live->desc->links;
  const auto at = index_in(links, link.substr(split + 2));
  if (!at) {
    throw Error("model '" + live->desc->name + "' has no link '" +
                printable(link.substr(split + 2)) + "'; known are " + join_names(names_in(links)));
  }
  if (sensor.plugin.empty()) throw Error(sensor.source, "the sensor has no <plugin>");
  SensorInstance instance = make_sensor(*live, *at, std::make_shared<const desc::Sensor>(sensor),
                                        sensor.name, *catalog_, warnings_);
  registry_.check(instance);
  instance.attached = true;
  start(instance, now);
  registry_.add(instance, *live);
  live->sensors.push_back(std::move(instance));
  note_change(number_of(*live));
}

void Building::displace(const std::string& kind, const std::string& name, const Pose& by) {
  LiveModel* live = registry_.with_sensor(kind, name);
  if (live == nullptr) return;
  for (SensorInstance& sensor : live->sensors) {
    if (sensor.kind != kind || sensor.name != name) continue;
    sensor.pose = sensor.pose * by;
    sensor.forget_regions();
    sensor.idle = sensor.up_to_date = false;
    sensor.unchanged = 0;
  }
  note_change(number_of(*live));
}

void Building::erase(const std::string& name) {
  const auto model = std::find_if(models_.begin(), models_.end(),
                                  [&](const auto& live) { return live->desc->name == name; });
  if (model != models_.end()) {
    engines_->remove((*model)->parts);
    pushes_.forget(**model);
    erase_if(placed_, [&](const auto& each) { return each == model->get(); });
    registry_.remove(**model);
    home_.note(**model);
    const auto number = static_cast<std::size_t>(model - models_.begin());
    const bool has_storeys = BuildingHome::may_have_storeys(*(*model)->desc);
    models_.erase(model);
    if (has_storeys) home_.find_storeys(*this, {});
    note_change(number);
    return;
  }
  for (auto& live : models_) {
    for (auto sensor = live->sensors.begin(); sensor != live->sensors.end(); ++sensor) {
      if (sensor->name != name) continue;
      if (!sensor->attached) {
        throw Error("sensor '" + name + "' is a part of model '" + live->desc->name +
                    "'; delete that");
      }
      registry_.remove(*sensor);
      live->sensors.erase(sensor);
      note_change(number_of(*live));
      return;
    }
  }
  throw Error("no model or attached sensor named '" + printable(name) + "'; " +
              did_you_mean(name, names_to_delete()));
}

void Building::reset(Nanoseconds now) {
  std::vector<std::unique_ptr<LiveModel>> old;
  old.swap(models_);
  faults_.reset();
  registry_.clear();
  for (const auto& live : old) {
    for (SensorInstance& sensor : live->sensors)
      sensor.forget_regions();  // they are regions of the engines
  }
  make_engines();
  for (const auto& live : old) {
    std::vector<SensorInstance> attached;
    for (SensorInstance& sensor : live->sensors) {
      if (sensor.attached) attached.push_back(std::move(sensor));
    }
    build(*live->desc, &attached, now);
    if (live->read != live->desc) models_.back()->read = live->read;
  }
  for (WorldLight& own : lights_) {
    own.live->devices.clear();
    make_lamp(*own.live, now);
  }
  warnings_.clear();
}

std::vector<std::string> Building::take_warnings() {
  return merge_alike(std::exchange(warnings_, {}));
}

}  // namespace angen::sim
