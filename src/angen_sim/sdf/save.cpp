#include <algorithm>

#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/load.h"
#include "sdf/rewrite.h"

namespace angen::load {

namespace {

void attach(Element& model, const AttachedSensor& attached) {
  Element* link = find_part(model, "link", attached.link);
  if (link == nullptr) {
    throw Error("sensor '" + attached.sensor.name + "' is attached to link '" + attached.link +
                "', which model '" + name_of(model) + "' does not have");
  }
  Element sensor = attached.sensor.element;
  set_attribute(sensor, "name", attached.sensor.name);
  set_attribute(sensor, "angen:name", attached.sensor.name);  // without the model's before it
  set_child(sensor, "pose", pose_text(attached.sensor.pose));
  link->children.push_back(std::move(sensor));
}

bool is_same_plugin(const Element& a, const Element& b) {
  const std::string file = a.attribute_text("filename");
  return a.name == "plugin" && !file.empty() && file == b.attribute_text("filename");
}

// Instead of the model's own of that library, or after those that it includes: the last holds.
void put_plugin(Element& model, Element plugin, bool is_actor) {
  Element* own = nullptr;
  for (Element& part : model.children) {
    if (is_same_plugin(part, plugin)) own = &part;
  }
  if (is_actor) {
    // An actor's <script> gives these again.
    for (const char* name : {"waypoint", "loop", "delay_start"}) {
      remove_children(plugin, name);
      if (own == nullptr) continue;
      for (const Element& given : own->children) {
        if (given.name == name) plugin.children.push_back(given);
      }
    }
  }
  if (own != nullptr) {
    *own = std::move(plugin);
  } else {
    model.children.push_back(std::move(plugin));
  }
}

Element written(const ModelState& state) {
  const desc::Model& model = *state.model;
  const bool changed = !state.attached.empty() || !state.lights.empty() || state.read != nullptr;
  const bool written_out = changed && !model.expanded_xml.empty();
  Element element = parse_xml(written_out ? model.expanded_xml : model.xml, model.name);
  if (element.name == "include") {
    set_child(element, "name", model.name);
  } else {
    set_attribute(element, "name", model.name);
  }
  if (state.read != nullptr) write_changes(*state.read, model, element);
  for (const AttachedSensor& attached : state.attached) attach(element, attached);
  for (const LightState& light : state.lights) {
    if (Element* link = find_part(element, "link", light.link)) write_lamp(light, *link);
  }
  for (const Element& plugin : state.plugins) put_plugin(element, plugin, model.is_actor);
  // An actor's own pose is where its trajectory's coordinates begin; <state> says where it is.
  if (model.is_actor) return element;
  set_child(element, "pose", pose_text(state.pose * model.placed));
  return element;
}

// A joint that is pushed a little into its stop is saved at the stop.
Element joint_state(const desc::Joint& joint, const std::vector<double>& positions) {
  Element element{"joint", "", {{"name", joint.name}}};
  for (std::size_t i = 0; i < std::min(positions.size(), joint.axes.size()); ++i) {
    const desc::JointAxis& axis = joint.axes[i];
    const double position = std::clamp(positions[i], axis.lower, axis.upper);
    element.children.push_back({"angle", number_text(position), {{"axis", std::to_string(i)}}});
  }
  return element;
}

Element model_state(const ModelState& state) {
  Element element{"model", "", {{"name", state.model->name}}};
  element.children.push_back(Element{"pose", pose_text(state.pose)});
  for (const auto& [name, positions] : state.joint_positions) {
    for (const desc::Joint& joint : state.model->joints) {
      if (joint.name != name || joint.axes.empty()) continue;
      element.children.push_back(joint_state(joint, positions));
    }
  }
  return element;
}

}  // namespace

std::string save(const desc::World& world, const std::vector<ModelState>& models) {
  WorldState read{world.physics, world.gravity, {}};
  for (const desc::Light& light : world.lights) read.lights.push_back({&light});
  return save(world, models, read);
}

std::string save(const desc::World& world, const std::vector<ModelState>& models,
                 const WorldState& now) {
  Element saved = parse_xml(world.xml, world.name);
  write_settings(world, now, saved);
  write_lights(world, now.lights, saved);
  Element states{"state", "", {{"world_name", world.name}}};
  for (const ModelState& state : models) {
    saved.children.push_back(written(state));
    if (!state.model->is_static) states.children.push_back(model_state(state));
  }
  if (!states.children.empty()) saved.children.push_back(std::move(states));
  Element root{"sdf", "", {{"version", "1.9"}}};
  root.children.push_back(std::move(saved));
  std::string text = print_xml(root);
  if (text.find("angen:") != std::string::npos) {  // other readers of XML want to know the prefix
    set_attribute(root, "xmlns:angen", "urn:angen");
    text = print_xml(root);
  }
  return "<?xml version=\"1.0\"?>\n" + text;
}

}  // namespace angen::load
