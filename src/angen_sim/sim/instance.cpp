#include "sim/instance.h"

#include <algorithm>

#include "core/names.h"
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

DeviceInstance make_device(const desc::Model& model, const ModelInfo& info,
                           const desc::Plugin& described,
                           const std::shared_ptr<const Plugin>& plugin, const Vec3& gravity) {
  return with_source(described.source, [&] {
    DeviceInstance instance;
    instance.kind = plugin->kind().name;
    instance.plugin = plugin;
    instance.library = described.filename;
    instance.device = plugin->make_device();
    instance.scratch.kind = instance.kind;
    Params params(described.element);
    instance.name =
        params.text("device_name", plugin->instance_name(info), "the name that commands use");
    const std::string problem = name_problem(instance.name);
    if (!problem.empty()) throw params.error("device_name", problem);
    ModelWiring wiring(model, instance.name, gravity);
    instance.device->configure(params, wiring);
    params.finish();
    instance.element = described.element;
    instance.device->save(instance.started_with);
    return instance;
  });
}

bool has_own(const desc::Model& model, const std::string& filename, std::size_t from = 0) {
  return std::any_of(model.plugins.begin() + static_cast<std::ptrdiff_t>(from), model.plugins.end(),
                     [&](const desc::Plugin& p) { return p.filename == filename; });
}

void make_devices(LiveModel& live, const std::vector<desc::Plugin>& world_plugins,
                  const Vec3& gravity, Catalog& catalog) {
  const desc::Model& model = *live.desc;
  const ModelInfo info = info_of(model);
  for (std::size_t i = 0; i < model.plugins.size(); ++i) {
    const desc::Plugin& described = model.plugins[i];
    if (has_own(model, described.filename, i + 1))
      continue;  // the <include>'s, which comes last, holds
    bool served = false;
    for (const auto& plugin :
         with_source(described.source, [&] { return catalog.library(described.filename); })) {
      if (!plugin->serves(info)) continue;
      live.devices.push_back(make_device(model, info, described, plugin, gravity));
      served = true;
    }
    if (!served) {
      throw Error(described.source, described.filename + " has nothing that serves model '" +
                                        model.name + "': it lacks the joints or lights of one");
    }
  }
  for (const desc::Plugin& described : world_plugins) {
    if (has_own(model, described.filename)) continue;
    for (const auto& plugin :
         with_source(described.source, [&] { return catalog.library(described.filename); })) {
      if (plugin->serves(info)) {
        live.devices.push_back(make_device(model, info, described, plugin, gravity));
      }
    }
  }
}

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
  for (const desc::Joint& joint : model.joints) {
    info.joints.push_back({joint.name, type_name(joint.type), joint.parent, joint.child});
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
    Params params(described.plugin_element, &described.element);
    instance.schedule.publish = params.update_period(instance.plugin->kind().rate);
    instance.topic = params.text("topicName", "", "topic, instead of /angen/KIND/NAME");
    if (instance.topic.empty()) {
      instance.topic = params.text("bumperTopicName", "", "the same, in a contact sensor");
    }
    instance.frame = params.text("frameName", "", "frame of its header, instead of its name");
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
  make_devices(live, world_plugins, gravity, catalog);
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
