#include <algorithm>

#include "core/text.h"
#include "load/describe.h"
#include "load/load.h"
#include "load/values.h"
#include "load/xml.h"

namespace angen::load {

namespace {

Element made(const std::string& name, const std::string& text = "") {
  Element element;
  element.name = name;
  element.text = text;
  return element;
}

// The link of a written-out model; "child::link" stands in the nested model `child`.
Element* find_link(Element& model, const std::string& name) {
  const std::size_t at = name.find("::");
  for (Element& child : model.children) {
    if (at == std::string::npos && child.name == "link" && name_of(child) == name) return &child;
    if (at != std::string::npos && child.name == "model" && name_of(child) == name.substr(0, at)) {
      return find_link(child, name.substr(at + 2));
    }
  }
  return nullptr;
}

void attach(Element& model, const AttachedSensor& attached) {
  Element* link = find_link(model, attached.link);
  if (link == nullptr) {
    throw Error("sensor '" + attached.sensor.name + "' is attached to link '" + attached.link +
                "', which model '" + name_of(model) + "' does not have");
  }
  Element sensor = attached.sensor.element;
  set_attribute(sensor, "name", attached.sensor.name);
  set_child(sensor, "pose", pose_text(attached.sensor.pose));
  link->children.push_back(std::move(sensor));
}

Element written(const ModelState& state) {
  const desc::Model& model = *state.model;
  const bool written_out = !state.attached.empty() && !model.expanded_xml.empty();
  Element element = parse_xml(written_out ? model.expanded_xml : model.xml, model.name);
  if (element.name == "include") {
    set_child(element, "name", model.name);
  } else {
    set_attribute(element, "name", model.name);
  }
  for (const AttachedSensor& attached : state.attached) attach(element, attached);
  // A person's pose follows from its trajectory.
  if (!model.links.empty() && model.links.front().upright) return element;
  set_child(element, "pose", pose_text(state.pose));
  return element;
}

// A joint that is pushed a little into its stop is saved at the stop.
Element joint_state(const desc::Joint& joint, const std::vector<double>& positions) {
  Element element = made("joint");
  set_attribute(element, "name", joint.name);
  for (std::size_t i = 0; i < std::min(positions.size(), joint.axes.size()); ++i) {
    const desc::JointAxis& axis = joint.axes[i];
    Element angle = made("angle", number_text(std::clamp(positions[i], axis.lower, axis.upper)));
    set_attribute(angle, "axis", std::to_string(i));
    element.children.push_back(std::move(angle));
  }
  return element;
}

Element model_state(const ModelState& state) {
  Element element = made("model");
  set_attribute(element, "name", state.model->name);
  element.children.push_back(made("pose", pose_text(state.pose)));
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
  Element saved = parse_xml(world.xml, world.name);
  Element states = made("state");
  set_attribute(states, "world_name", world.name);
  for (const ModelState& state : models) {
    saved.children.push_back(written(state));
    const bool person = !state.model->links.empty() && state.model->links.front().upright;
    if (!state.model->is_static && !person) states.children.push_back(model_state(state));
  }
  if (!states.children.empty()) saved.children.push_back(std::move(states));
  Element root = made("sdf");
  set_attribute(root, "version", "1.9");
  root.children.push_back(std::move(saved));
  return "<?xml version=\"1.0\"?>\n" + print_xml(root);
}

}  // namespace angen::load
