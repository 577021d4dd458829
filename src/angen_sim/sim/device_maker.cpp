#include "sim/device_maker.h"

#include <algorithm>
#include <optional>
#include <set>

#include "core/lists.h"
#include "core/named.h"
#include "core/names.h"
#include "desc/own_lamp.h"
#include "plugin/wiring.h"
#include "sim/wiring.h"

namespace angen::sim {

namespace {

// Whether the model has that plug-in, after the first `from`.
bool has_own(const desc::Model& model, const desc::Plugin& plugin, std::size_t from = 0) {
  return std::any_of(model.plugins.begin() + static_cast<std::ptrdiff_t>(from), model.plugins.end(),
                     [&](const desc::Plugin& other) {
                       return other.filename == plugin.filename &&
                              (!plugin.is_repeatable || other.name == plugin.name);
                     });
}

bool names(const Element& element, const std::string& text) {
  return element.text == text ||
         std::any_of(element.children.begin(), element.children.end(),
                     [&](const Element& child) { return names(child, text); });
}

/// Makes the devices of a model, and the sensors that its plug-ins are.
class DeviceMaker {
 public:
  DeviceMaker(LiveModel& live, Catalog& catalog, std::vector<std::string>& warnings)
      : live_(live),
        model_(*live.desc),
        catalog_(catalog),
        warnings_(warnings),
        info_(info_of(*live.desc)) {
    info_.storeys = live.storeys;
  }

  void make_all(const std::vector<desc::Plugin>& world_plugins) {
    for (std::size_t i = 0; i < model_.plugins.size(); ++i) {
      const desc::Plugin& described = model_.plugins[i];
      // The <include>'s, which comes last, holds.
      if (has_own(model_, described, i + 1)) continue;
      try {
        if (!make_of(described, true)) throw serves_nothing(described);
      } catch (const Error& error) {
        for (const std::string& text : set_aside(error, model_.customs)) warn(text);
      }
    }
    for (ModelInfo::Joint& joint : info_.joints) joint.taken = is_taken(joint.name);
    for (const desc::Plugin& described : world_plugins) {
      if (!has_own(model_, described)) make_of(described, false);
    }
  }

  void make_own_lamps() {
    int index = -1;
    for (const desc::Link& link : model_.links) {
      for (const desc::Light& light : link.lights) {
        ++index;
        if (lit_.count(index) != 0 || !(light.level || model_.customs.lights_are_lamps)) continue;
        try {
          DeviceInstance lamp = own_lamp(light, index, nullptr);
          check_alone(light.source, lamp);
          live_.devices.push_back(std::move(lamp));
        } catch (const Error& error) {
          for (const std::string& text : ignored(error)) warn(text);
        }
      }
    }
  }

  /// With the settings of `before`, if it is given.
  DeviceInstance own_lamp(const desc::Light& light, int index, const DeviceInstance* before) {
    const std::string name = live_.is_light ? light.name : model_.name + "_" + light.name;
    desc::Plugin described = desc::own_lamp(light, name, light.level.value_or(100.0));
    if (before != nullptr && before->error.empty()) {
      SavedParams params;
      before->device->save(params);
      params.write_to(described.element);
    }
    for (const auto& plugin : library(described)) {
      if (plugin->kind().name != described.name) continue;
      DeviceInstance lamp = make(described, plugin, {name, ""});
      lamp.own_light = index;
      return lamp;
    }
    throw Error(light.source, described.filename + " has no " + described.name);
  }

  // A door without its plug-in would swing freely, and no command would reach it; the
  // same holds for the wheels of a robot.
  void warn_of_idle_joints() {
    for (const ModelInfo::Joint& joint : info_.joints) {
      const bool endless = joint.upper - joint.lower > 2e15;
      const bool door = joint.on_world && joint.vertical() && !endless;
      const bool wheel = !joint.on_world && endless && joint.type == "revolute";
      if (is_taken(joint.name) || (!door && !wheel)) continue;
      for (const auto& plugin : catalog_.own()) {
        if (!would_drive(*plugin, joint)) continue;
        const auto described = std::find_if(model_.joints.begin(), model_.joints.end(),
                                            [&](const auto& j) { return j.name == joint.name; });
        const std::string& kind = plugin->kind().name;
        std::string text = "no plug-in drives joint '";
        text.append(joint.name).append("' of model '").append(model_.name);
        text.append("'; for ").append(kind).append(" add <plugin name=\"").append(kind);
        text.append("\" filename=\"").append(catalog_.library_of(*plugin));
        text.append("\"/> to the model or the world");
        warn(Diagnostic{Diagnostic::Severity::kWarning, described->source, text}.text());
      }
    }
  }

  void describe_declared() {
    if (bodies_.empty() && led_.empty()) return;
    desc::Model described = model_;
    for (const auto& [link, anatomy] : bodies_) {
      described.links[static_cast<std::size_t>(link)].anatomy = anatomy;
    }
    for (const auto& [joint, longest_step] : led_) {
      described.joints[static_cast<std::size_t>(joint)].longest_step = longest_step;
    }
    live_.desc = live_.read = std::make_shared<const desc::Model>(std::move(described));
  }

 private:
  // Once where several leaves read one plug-in.
  void warn(const std::string& text) {
    if (is_in(text, warnings_)) return;
    warnings_.push_back(text);
  }

  Params params_of(const desc::Plugin& described) const {
    Params params(described.element);
    if (model_.customs.first_holds) params.take_first();
    return params;
  }

  // A device has the joint, or one of the model's plug-ins names it, whether it is known or not.
  bool is_taken(const std::string& joint) const {
    return driven_.count(joint) != 0 ||
           std::any_of(model_.plugins.begin(), model_.plugins.end(),
                       [&](const desc::Plugin& each) { return names(each.element, joint); });
  }

  // Whether there was anything that serves the model. `own`: it is the model's, not the world's.
  bool make_of(const desc::Plugin& described, bool own) {
    bool served = false;
    for (const auto& plugin : library(described)) {
      if (own && make_sensor_of(described, *plugin)) served = true;
      for (const Mount& mount : mounts_of(described, *plugin, own)) {
        DeviceInstance device = make(described, plugin, mount);
        check_alone(described.source, device);
        live_.devices.push_back(std::move(device));
        served = true;
      }
    }
    return served;
  }

  void check_alone(const Source& source, const DeviceInstance& device) const {
    for (const DeviceInstance& other : live_.devices) {
      if (other.kind != device.kind || other.name != device.name) continue;
      throw Error(source, "model '" + model_.name + "' has a second " + device.kind + " '" +
                              device.name + "'; names of a kind must differ");
    }
  }

  // A sensor that is a plug-in of the model.
  bool make_sensor_of(const desc::Plugin& described, const Plugin& plugin) {
    Params params = params_of(described);
    const std::optional<std::string> link = plugin.link_of(params);
    if (!link) return false;
    desc::Sensor sensor;
    sensor.name = name_problem(described.name).empty() ? described.name : plugin.kind().name;
    sensor.type = plugin.kind().name;
    sensor.plugin = described.filename;
    sensor.plugin_element = described.element;
    sensor.source = described.source;
    const std::string name = model_.name + "_" + sensor.name;
    const std::uint32_t index = with_source(described.source, [&] { return link_index(*link); });
    auto shared = std::make_shared<const desc::Sensor>(std::move(sensor));
    live_.sensors.push_back(make_sensor(live_, index, shared, name, catalog_, warnings_, &plugin));
    return true;
  }

  // The index of "link" or "model::link"; the first for "".
  std::uint32_t link_index(const std::string& name) const {
    if (name.empty()) return 0;
    if (const auto index = index_in(model_.links, local_name(model_.name, name))) return *index;
    throw Error("model '" + model_.name + "' has no link '" + name + "'; known are " +
                join_names(info_.links));
  }

  std::vector<std::shared_ptr<const Plugin>> library(const desc::Plugin& described) const {
    return with_source(described.source, [&] { return catalog_.library(described.filename); });
  }

  std::vector<Mount> mounts_of(const desc::Plugin& described, const Plugin& plugin,
                               bool own) const {
    return with_source(described.source, [&] {
      Params params = params_of(described);
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
      instance.joint = mount.joint;
      instance.device = plugin->make_device_on(mount);
      instance.scratch.kind = instance.kind;
      Params params = params_of(described);
      instance.name = read_device_name(params, mount.name);
      const std::string problem = name_problem(instance.name);
      if (!problem.empty()) throw params.error("device_name", problem);
      ModelWiring wiring(model_, live_.storeys, instance.name);
      instance.device->configure(params, wiring);
      for (const std::string& text : finish(params, model_.customs)) warn(text);
      instance.element = described.element;
      instance.device->save(instance.started_with);
      instance.body = wiring.body().first;
      if (instance.body >= 0) bodies_.push_back(wiring.body());
      led_.insert(led_.end(), wiring.led().begin(), wiring.led().end());
      driven_.insert(wiring.joints().begin(), wiring.joints().end());
      lit_.insert(wiring.lights().begin(), wiring.lights().end());
      return instance;
    });
  }

  void check_joints_named(const desc::Plugin& described) const {
    for (const Element& child : described.element.children) {
      if (child.name != "joint" || info_.joint(child.text) != nullptr) continue;
      throw Error(child.source, "model '" + model_.name + "' has no joint '" + child.text +
                                    "'; known are " + join_names(names_in(info_.joints)));
    }
  }

  Error serves_nothing(const desc::Plugin& described) const {
    std::string needs;
    for (const auto& plugin : library(described)) {
      if (plugin->needs().empty()) continue;
      needs += "; " + plugin->kind().name + " needs " + plugin->needs();
    }
    if (needs.empty()) needs = ": it lacks the joints or lights of one";
    return Error(described.source, described.filename + " has nothing that serves model '" +
                                       model_.name + "'" + needs);
  }

  bool would_drive(const Plugin& plugin, const ModelInfo::Joint& joint) const {
    Params nothing{Element{}};
    const std::vector<Mount> mounts = plugin.mounts(info_, nothing);
    return std::any_of(mounts.begin(), mounts.end(),
                       [&](const Mount& mount) { return mount.joint == joint.name; });
  }

  LiveModel& live_;
  const desc::Model& model_;
  Catalog& catalog_;
  std::vector<std::string>& warnings_;
  ModelInfo info_;
  std::set<std::string> driven_;                 // joints that a device has
  std::set<int> lit_;                            // lights that one has, by LightRef
  std::vector<std::pair<int, Anatomy>> bodies_;  // links whose anatomy one has declared
  std::vector<std::pair<int, double>> led_;      // joints that one leads
};

}  // namespace

void make_devices(LiveModel& live, const std::vector<desc::Plugin>& world_plugins, Catalog& catalog,
                  std::vector<std::string>& warnings) {
  DeviceMaker maker(live, catalog, warnings);
  maker.make_all(world_plugins);
  maker.warn_of_idle_joints();
  maker.make_own_lamps();
  maker.describe_declared();
}

void remake_own_lamp(LiveModel& live, DeviceInstance& lamp, bool keep_level, Catalog& catalog,
                     std::vector<std::string>& warnings) {
  std::vector<const desc::Light*> lights;
  for (const desc::Link& link : live.desc->links) {
    for (const desc::Light& light : link.lights) lights.push_back(&light);
  }
  DeviceMaker maker(live, catalog, warnings);
  DeviceInstance made = maker.own_lamp(*lights.at(static_cast<std::size_t>(lamp.own_light)),
                                       lamp.own_light, keep_level ? &lamp : nullptr);
  lamp.device = std::move(made.device);
  lamp.element = std::move(made.element);
  lamp.error.clear();
  lamp.idle_until = 0;
  lamp.to_report = true;
}

std::vector<std::string> ignored(const Error& error) {
  std::vector<std::string> texts;
  for (const Diagnostic& each : error.diagnostics()) texts.push_back(each.text() + " (ignored)");
  return texts;
}

std::vector<std::string> set_aside(const Error& error, const desc::Customs& customs) {
  if (!customs.sets_aside) throw Error(error);
  return ignored(error);
}

std::vector<std::string> finish(const Params& params, const desc::Customs& customs) {
  std::vector<std::string> texts;
  if (!customs.sets_aside) params.finish();
  for (const Diagnostic& each : params.unread()) texts.push_back(each.text() + " (ignored)");
  for (const Diagnostic& warning : params.warnings()) texts.push_back(warning.text());
  return texts;
}

}  // namespace angen::sim
