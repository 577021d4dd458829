#include "sim/instance.h"

#include <algorithm>
#include <set>

#include "core/names.h"
#include "plugin/ray_color.h"
#include "sim/joined.h"
#include "sim/wiring.h"

namespace angen::sim {

namespace {

constexpr MoverIndex::Moment kUnmoved = 1000;  // ticks, after which a mover is settled in caches

const char* type_name(desc::Joint::Type type) {
  switch (type) {
    case desc::Joint::Type::kFixed:
      return "fixed";
    case desc::Joint::Type::kRevolute:
      return "revolute";
    case desc::Joint::Type::kPrismatic:
      return "prismatic";
    case desc::Joint::Type::kBall:
      return "ball";
    case desc::Joint::Type::kUniversal:
      return "universal";
  }
  return "";
}

// The world, and what can never move against it.
std::set<std::string> fixed_to_world(const desc::Model& model) {
  std::set<std::string> fixed{"world"};
  for (const desc::Link& link : model.links) {
    if (model.is_static || link.kinematic) fixed.insert(link.name);
  }
  return joined_to(std::move(fixed), model, true, is_fixed);
}

// An error in a plug-in gets the plug-in's file and line, unless it has some already.
template <class F>
auto with_source(const Source& source, F&& make) {
  try {
    return make();
  } catch (const Error& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& d : diagnostics) {
      if (d.source.file.empty()) d.source = source;
    }
    throw Error(std::move(diagnostics));
  }
}

bool has_own(const desc::Model& model, const std::string& filename, std::size_t from = 0) {
  return std::any_of(model.plugins.begin() + static_cast<std::ptrdiff_t>(from), model.plugins.end(),
                     [&](const desc::Plugin& p) { return p.filename == filename; });
}

/// Makes the devices of a model.
class DeviceMaker {
 public:
  DeviceMaker(LiveModel& live, const Vec3& gravity, Catalog& catalog,
              std::vector<std::string>& warnings)
      : live_(live),
        model_(*live.desc),
        gravity_(gravity),
        catalog_(catalog),
        warnings_(warnings),
        info_(info_of(*live.desc)) {}

  void make_all(const std::vector<desc::Plugin>& world_plugins) {
    for (std::size_t i = 0; i < model_.plugins.size(); ++i) {
      const desc::Plugin& described = model_.plugins[i];
      // The <include>'s, which comes last, holds.
      if (has_own(model_, described.filename, i + 1)) continue;
      if (!make_of(described, true)) throw serves_nothing(described);
    }
    for (ModelInfo::Joint& joint : info_.joints) joint.taken = driven_.count(joint.name) != 0;
    for (const desc::Plugin& described : world_plugins) {
      if (!has_own(model_, described.filename)) make_of(described, false);
    }
  }

  // A door that nobody has given its plug-in would swing freely, and no command would reach it.
  void warn_of_idle_joints() {
    for (const ModelInfo::Joint& joint : info_.joints) {
      if (!joint.on_world || driven_.count(joint.name) != 0) continue;
      if (!joint.vertical() || joint.upper - joint.lower > 2e15) continue;
      for (const auto& plugin : catalog_.own()) {
        if (!would_drive(*plugin, joint)) continue;
        const auto described = std::find_if(model_.joints.begin(), model_.joints.end(),
                                            [&](const auto& j) { return j.name == joint.name; });
        const std::string& kind = plugin->kind().name;
        const std::string text = "no plug-in drives joint '" + joint.name + "' of model '" +
                                 model_.name + "'; for " + kind + " add <plugin name=\"" + kind +
                                 "\" filename=\"" + catalog_.library_of(*plugin) +
                                 "\"/> to the model or the world";
        warn(Diagnostic{Diagnostic::Severity::kWarning, described->source, text}.text());
      }
    }
  }

 private:
  // Once where several leaves read one plug-in.
  void warn(const std::string& text) {
    if (std::find(warnings_.begin(), warnings_.end(), text) != warnings_.end()) return;
    warnings_.push_back(text);
  }

  // Whether there was anything that serves the model. `own`: it is the model's, not the world's.
  bool make_of(const desc::Plugin& described, bool own) {
    bool served = false;
    for (const auto& plugin : library(described)) {
      for (const Mount& mount : mounts_of(described, *plugin, own)) {
        DeviceInstance device = make(described, plugin, mount);
        for (const DeviceInstance& other : live_.devices) {
          if (other.kind != device.kind || other.name != device.name) continue;
          throw Error(described.source, "model '" + model_.name + "' has a second " + device.kind +
                                            " '" + device.name + "'; names of a kind must differ");
        }
        live_.devices.push_back(std::move(device));
        served = true;
      }
    }
    return served;
  }

  std::vector<std::shared_ptr<const Plugin>> library(const desc::Plugin& described) const {
    return with_source(described.source, [&] { return catalog_.library(described.filename); });
  }

  std::vector<Mount> mounts_of(const desc::Plugin& described, const Plugin& plugin,
                               bool own) const {
    return with_source(described.source, [&] {
      Params params(described.element);
      std::vector<Mount> mounts = plugin.mounts(info_, params);
      const bool takes_joints =
          std::any_of(params.docs().begin(), params.docs().end(),
                      [](const ParamDoc& doc) { return doc.path == "joint"; });
      if (own && takes_joints) check_joints_named(described);
      if (mounts.size() > 1 && params.has("device_name")) {
        throw params.error("device_name",
                           "<device_name> would name " + std::to_string(mounts.size()) +
                               " devices of model '" + model_.name + "'; name their links instead");
      }
      return mounts;
    });
  }

  DeviceInstance make(const desc::Plugin& described, const std::shared_ptr<const Plugin>& plugin,
                      const Mount& mount) {
    return with_source(described.source, [&] {
      DeviceInstance instance;
      instance.kind = plugin->kind().name;
      instance.plugin = plugin;
      instance.library = described.filename;
      instance.device = plugin->make_device_on(mount);
      instance.scratch.kind = instance.kind;
      Params params(described.element);
      instance.name = params.text("device_name", mount.name, "the name that commands use");
      const std::string problem = name_problem(instance.name);
      if (!problem.empty()) throw params.error("device_name", problem);
      ModelWiring wiring(model_, instance.name, gravity_);
      instance.device->configure(params, wiring);
      params.finish();
      for (const Diagnostic& warning : params.warnings()) warn(warning.text());
      instance.element = described.element;
      instance.device->save(instance.started_with);
      driven_.insert(wiring.joints().begin(), wiring.joints().end());
      return instance;
    });
  }

  void check_joints_named(const desc::Plugin& described) const {
    for (const Element& child : described.element.children) {
      if (child.name != "joint" || info_.joint(child.text) != nullptr) continue;
      std::vector<std::string> known;
      for (const ModelInfo::Joint& joint : info_.joints) known.push_back(joint.name);
      throw Error(child.source, "model '" + model_.name + "' has no joint '" + child.text +
                                    "'; known are " + join_names(known));
    }
  }

  Error serves_nothing(const desc::Plugin& described) const {
    std::string wanted;
    for (const auto& plugin : library(described)) {
      if (plugin->needs().empty()) continue;
      wanted += "; " + plugin->kind().name + " needs " + plugin->needs();
    }
    if (wanted.empty()) wanted = ": it lacks the joints or lights of one";
    return Error(described.source, described.filename + " has nothing that serves model '" +
                                       model_.name + "'" + wanted);
  }

  bool would_drive(const Plugin& plugin, const ModelInfo::Joint& joint) const {
    Params nothing{Element{}};
    const std::vector<Mount> mounts = plugin.mounts(info_, nothing);
    return std::any_of(mounts.begin(), mounts.end(),
                       [&](const Mount& mount) { return mount.joint == joint.name; });
  }

  LiveModel& live_;
  const desc::Model& model_;
  const Vec3& gravity_;
  Catalog& catalog_;
  std::vector<std::string>& warnings_;
  ModelInfo info_;
  std::set<std::string> driven_;  // joints that a device has
};

/// The reading of a sensor whose noise is declared, while its values before noise stay.
class CleanWithNoise : public LazyReading {
 public:
  CleanWithNoise(Reading clean, std::vector<Noise> noise)
      : clean_(std::move(clean)), noise_(std::move(noise)) {}
  void read(Nanoseconds, const Draws& draws, Reading& reading) const override {
    reading.fields = with_noise(noise_, clean_, draws(0)).fields;
  }

 private:
  Reading clean_;
  std::vector<Noise> noise_;
};

std::size_t sensor_count(const desc::Model& model) {
  std::size_t count = 0;
  for (const desc::Link& link : model.links) count += link.sensors.size();
  return count;
}

}  // namespace

void CachedScan::measure(Engines& engines) {
  cache.measure(engines.rays);
  region.resize(cache.reach());
  changed = true;
  settled_at = 0;
  settled = 0;
}

bool CachedScan::cast(const Engines& engines, MoverIndex::SplitMovers& scratch,
                      std::vector<rays::Hit>& hits) {
  const MoverIndex::Moment now = engines.movers.now();
  hits.resize(cache.size());
  region.split(settled_at, scratch);
  // No mover joins those that have not moved since some moment, so an equal count means the same
  // ones.
  if (scratch.still.size() != settled || scratch.longest + kUnmoved < now) {
    settled_at = now - std::min(now, kUnmoved);
    region.split(settled_at, scratch);
    settled = scratch.still.size();
    cache.settle(engines.rays, scratch.still);
    changed = true;
  }
  const bool meets = cache.cast(engines.rays, scratch.moving, hits.data());
  const bool same = !changed && !meets;
  changed = meets;
  return same;
}

bool SensorInstance::varies() const {
  if (noisy != nullptr) return noisy->varies();
  return std::any_of(noise.begin(), noise.end(),
                     [&](const Noise& each) { return each.varies(clean); });
}

std::shared_ptr<const LazyReading> SensorInstance::lazy_reading() const {
  if (noisy != nullptr) return noisy->lazy_reading();
  return std::make_shared<CleanWithNoise>(clean, noise);
}

ModelInfo info_of(const desc::Model& model) {
  ModelInfo info;
  info.name = model.name;
  info.pose = model.pose;
  for (const desc::Link& link : model.links) {
    info.links.push_back(link.name);
    for (const desc::Light& light : link.lights) info.lights.push_back(light.name);
  }
  const std::set<std::string> fixed = fixed_to_world(model);
  for (const desc::Joint& joint : model.joints) {
    ModelInfo::Joint as{joint.name, type_name(joint.type), joint.parent, joint.child};
    as.height = (model.pose * joint.anchor).z();
    as.on_world = fixed.count(joint.parent) != 0 && fixed.count(joint.child) == 0;
    if (!joint.axes.empty()) {
      as.axis = model.pose.rotation * joint.axes[0].xyz;
      as.lower = joint.axes[0].lower;
      as.upper = joint.axes[0].upper;
    }
    info.joints.push_back(std::move(as));
  }
  return info;
}

SensorInstance make_sensor(const LiveModel& live, std::uint32_t link,
                           std::shared_ptr<const desc::Sensor> shared, const std::string& name,
                           const Vec3& gravity, Catalog& catalog) {
  const desc::Sensor& described = *shared;
  return with_source(described.source, [&] {
    SensorInstance instance;
    for (const auto& plugin : catalog.library(described.plugin)) {
      instance.sensor = plugin->make_sensor();
      instance.plugin = plugin;
      if (instance.sensor) break;
    }
    if (!instance.sensor) throw Error(described.plugin + " holds no sensor");
    instance.noisy = dynamic_cast<NoisySensor*>(instance.sensor.get());
    instance.kind = instance.plugin->kind().name;
    instance.name = name;
    instance.key = hash_bytes(instance.kind + "/" + name);
    instance.desc = shared;
    instance.link = link;
    instance.pose = described.pose;
    instance.latest.kind = instance.clean.kind = instance.kind;
    Params params(described.plugin_element, &described.element, instance.plugin->kind().rate);
    instance.schedule.publish = params.update_period();
    instance.topic = params.text("topicName", "", "topic, instead of /angen/KIND/NAME");
    if (instance.topic.empty()) {
      instance.topic = params.text("bumperTopicName", "", "the same, in a contact sensor");
    }
    instance.frame = params.text("frameName", "", "frame of its header, instead of its name");
    if (!instance.plugin->kind().ray_color.empty()) {
      read_ray_color(params, instance.plugin->kind());
    }
    ModelWiring wiring(*live.desc, name, gravity, live.desc->links[link].name);
    instance.sensor->configure(params, wiring);
    params.finish();
    instance.noise = params.all_noise();
    instance.collisions = wiring.collisions();
    instance.schedule.sample = instance.sensor->sample_period();
    if (instance.schedule.sample <= 0) instance.schedule.sample = instance.schedule.publish;
    instance.link_moves = !live.desc->is_static;
    return instance;
  });
}

void make_instances(LiveModel& live, const std::vector<desc::Plugin>& world_plugins,
                    const Vec3& gravity, Catalog& catalog, std::vector<std::string>& warnings) {
  DeviceMaker maker(live, gravity, catalog, warnings);
  maker.make_all(world_plugins);
  maker.warn_of_idle_joints();
  const desc::Model& model = *live.desc;
  const bool alone = sensor_count(model) == 1;
  for (std::uint32_t i = 0; i < model.links.size(); ++i) {
    for (const desc::Sensor& described : model.links[i].sensors) {
      if (described.plugin.empty()) {
        warnings.push_back(Diagnostic{Diagnostic::Severity::kWarning, described.source,
                                      "sensor '" + described.name + "' of model '" + model.name +
                                          "' has no plug-in: it measures nothing"}
                               .text());
        continue;
      }
      const std::string name = alone ? model.name : model.name + "_" + described.name;
      live.sensors.push_back(make_sensor(live, i, {live.desc, &described}, name, gravity, catalog));
    }
  }
}

}  // namespace angen::sim
