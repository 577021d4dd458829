#include "sim/instance.h"

#include <algorithm>
#include <optional>

#include "plugin/declared.h"
#include "plugin/ray_geometry.h"
#include "plugin/wiring.h"
#include "sim/device_maker.h"
#include "sim/joined.h"
#include "sim/wiring.h"

namespace angen::sim {

namespace {

constexpr MoverIndex::Moment kUnmoved = 1000;  // ticks, after which a mover is settled in caches

// The world, and all links that can never move against it.
std::set<std::string> fixed_to_world(const desc::Model& model) {
  std::set<std::string> fixed{"world"};
  for (const desc::Link& link : model.links) {
    if (model.is_static || link.kinematic) fixed.insert(link.name);
  }
  return joined_to(std::move(fixed), model, true, is_fixed);
}

/// Adds declared noise to the readings of a lazy reading, or to one that stays.
class LazyWithNoise : public LazyReading {
 public:
  LazyWithNoise(std::shared_ptr<const LazyReading> clean, Reading last, std::vector<Noise> noise)
      : clean_(std::move(clean)), last_(std::move(last)), noise_(std::move(noise)) {}
  void read(Nanoseconds time, const Draws& draws, Reading& reading) const override {
    reading.fields = last_.fields;
    if (clean_) clean_->read(time, draws, reading);
    reading.fields = with_noise(noise_, reading, draws(0)).fields;
  }

 private:
  std::shared_ptr<const LazyReading> clean_;  // null: the last one
  Reading last_;
  std::vector<Noise> noise_;
};

// The pose on its link of a sensor that is a model's plug-in.
Pose offset_in(Params& params) {
  Pose offset;
  const auto vector = [&](const char* name, const char* unit, const char* doc) {
    const std::vector<std::vector<double>> rows = params.rows(name, 3, unit, doc);
    return rows.empty() ? Vec3(Vec3::Zero()) : Vec3(rows[0][0], rows[0][1], rows[0][2]);
  };
  offset.position = vector("xyzOffset", "m", "where it sits on its link");
  const Vec3 rpy = vector("rpyOffset", "rad", "how it is turned there");
  offset.rotation = from_rpy(rpy.x(), rpy.y(), rpy.z());
  return offset;
}

// The name of a sensor that was spawned on a model, in a saved world; null for a model's own.
const std::string* kept_name(const desc::Sensor& sensor) {
  return sensor.element.attribute("angen:name");
}

std::size_t own_sensors(const desc::Model& model) {
  std::size_t count = 0;
  for (const desc::Link& link : model.links) {
    for (const desc::Sensor& sensor : link.sensors) count += kept_name(sensor) == nullptr ? 1 : 0;
  }
  return count;
}

}  // namespace

void CachedScan::measure(Engines& engines) {
  cache.measure(engines.rays);
  region.resize(cache.reach());
  settled_at = 0;
  settled = 0;
  may_differ = true;
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
    may_differ = true;
  }
  const bool hit_before = may_differ;
  may_differ = cache.cast(engines.rays, scratch.moving, hits.data());
  return may_differ || hit_before;
}

void SensorInstance::forget_regions() {
  scans.clear();
  light.reset();
  near.reset();
}

std::shared_ptr<const LazyReading> SensorInstance::lazy_reading() const {
  std::shared_ptr<const LazyReading> own = sensor->lazy_reading();
  const auto varies = [&](const Noise& each) { return own || each.varies(clean); };
  if (std::none_of(noise.begin(), noise.end(), varies)) return own;
  return std::make_shared<LazyWithNoise>(std::move(own), clean, noise);
}

Numbering numbering_after(const LiveModel& live) {
  const auto after = [](std::uint32_t first, const auto& all) {
    return first + static_cast<std::uint32_t>(all.size());
  };
  return {after(live.first_link, live.desc->links), after(live.first_joint, live.desc->joints),
          after(live.first_device, live.devices), after(live.first_sensor, live.sensors),
          after(live.first_light, live.parts.lamps)};
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
    ModelInfo::Joint as{joint.name, joint.type_name(), joint.parent, joint.child};
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

namespace {

/// The sensor of a library whose kind is the name of the element; or null.
const Plugin* named_in(const std::vector<std::shared_ptr<const Plugin>>& library,
                       const Element& element) {
  const std::string* name = element.attribute("name");
  if (name == nullptr) return nullptr;
  const auto found = std::find_if(library.begin(), library.end(), [&](const auto& plugin) {
    return plugin->kind().name == *name && plugin->makes_sensors();
  });
  return found != library.end() ? found->get() : nullptr;
}

bool is_served(const LiveModel& live, const desc::Sensor& sensor) {
  return std::any_of(live.sensors.begin(), live.sensors.end(), [&](const SensorInstance& other) {
    return other.serves.count(sensor.name) != 0;
  });
}

}  // namespace

SensorInstance make_sensor(const LiveModel& live, std::uint32_t link,
                           std::shared_ptr<const desc::Sensor> shared, const std::string& name,
                           Catalog& catalog, std::vector<std::string>& warnings,
                           const Plugin* only) {
  const desc::Sensor& described = *shared;
  return with_source(described.source, [&] {
    SensorInstance instance;
    std::optional<Params> read;
    const auto& library = catalog.library(described.plugin);
    const Plugin* chosen = only != nullptr ? only : named_in(library, described.plugin_element);
    for (const auto& plugin : library) {
      if (chosen != nullptr && plugin.get() != chosen) continue;
      read.emplace(described.plugin_element, &described.element, plugin->kind().rate());
      if (live.desc->customs.first_holds) read->take_first();
      instance.sensor = plugin->make_sensor(*read);
      instance.plugin = plugin;
      if (instance.sensor) break;
    }
    if (!instance.sensor) throw Error(described.plugin + " has no sensor");
    Params& params = *read;
    instance.kind = instance.plugin->kind().name;
    instance.name = name;
    instance.key = hash_bytes(instance.kind + "/" + name);
    instance.desc = shared;
    instance.link = link;
    instance.pose = described.pose;
    instance.latest.kind = instance.clean.kind = instance.kind;
    instance.schedule.publish = params.update_period();
    instance.topic = params.text("topicName", "", "topic, instead of /angen/KIND/NAME");
    if (instance.topic.empty()) {
      instance.topic = params.text("bumperTopicName", "", "the same, in a contact sensor");
    }
    instance.frame = params.text("frameName", "", "frame of its header, instead of its name");
    instance.faults = parse_faults(params.text("fault", "", "a simulated fault"));
    if (!instance.plugin->kind().ray_color().empty()) {
      read_ray_color(params, instance.plugin->kind());
    }
    ModelWiring wiring(*live.desc, live.storeys, name, live.desc->links[link].name);
    instance.sensor->configure(params, wiring);
    instance.plugin->link_of(params);
    if (only != nullptr) instance.pose = instance.pose * offset_in(params);
    for (std::string& text : finish(params, live.desc->customs))
      warnings.push_back(std::move(text));
    if (const std::optional<RayGeometry> rays = instance.sensor->rays()) {
      instance.rays = std::make_shared<const RayGeometry>(*rays);
    }
    instance.noise = params.all_noise();
    check_noise(instance.plugin->kind(), instance.noise);
    instance.collisions = wiring.collisions();
    instance.serves = wiring.sensors();
    instance.schedule.sample = instance.sensor->sample_period();
    if (instance.schedule.sample <= 0) instance.schedule.sample = instance.schedule.publish;
    instance.link_moves = !live.desc->is_static;
    return instance;
  });
}

void make_instances(LiveModel& live, const std::vector<desc::Plugin>& world_plugins,
                    Catalog& catalog, std::vector<std::string>& warnings) {
  make_devices(live, world_plugins, catalog, warnings);
  const desc::Model& model = *live.desc;
  const bool alone = own_sensors(model) == 1;
  for (std::uint32_t i = 0; i < model.links.size(); ++i) {
    for (const desc::Sensor& described : model.links[i].sensors) {
      if (described.plugin.empty()) {
        if (is_served(live, described)) continue;
        warnings.push_back(Diagnostic{Diagnostic::Severity::kWarning, described.source,
                                      "sensor '" + described.name + "' of model '" + model.name +
                                          "' has no plug-in: it measures nothing"}
                               .text());
        continue;
      }
      const std::string* kept = kept_name(described);
      const std::string name = kept != nullptr ? *kept
                               : alone         ? model.name
                                               : model.name + "_" + described.name;
      try {
        live.sensors.push_back(
            make_sensor(live, i, {live.desc, &described}, name, catalog, warnings));
      } catch (const Error& error) {
        for (std::string& text : set_aside(error, model.customs)) {
          warnings.push_back(std::move(text));
        }
      }
    }
  }
}

}  // namespace angen::sim
