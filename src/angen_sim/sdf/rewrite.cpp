#include "sdf/rewrite.h"

#include <algorithm>

#include "core/lists.h"
#include "core/text.h"
#include "document/dialect.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/describe.h"

namespace angen::load {

namespace {

std::string vector_text(const Vec3& v) {
  return number_text(v.x()) + " " + number_text(v.y()) + " " + number_text(v.z());
}

// Attributes of the old child, such as another frame, are dropped.
void replace_child(Element& element, Element child) {
  remove_children(element, child.name);
  element.children.push_back(std::move(child));
}

Element& child_made(Element& element, const std::string& name) {
  if (Element* found = find_child(element, name)) return *found;
  element.children.push_back(Element{name});
  return element.children.back();
}

bool equal(const desc::Inertial& a, const desc::Inertial& b) {
  return a.mass == b.mass && a.pose == b.pose && a.moment == b.moment;
}

Element inertial_element(const desc::Inertial& inertial) {
  Element element{"inertial"};
  element.children.push_back(Element{"mass", number_text(inertial.mass)});
  element.children.push_back(Element{"pose", pose_text(inertial.pose)});
  Element inertia{"inertia"};
  const char* const axes = "xyz";
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const std::string name = std::string("i") + axes[i] + axes[j];
      inertia.children.push_back(Element{name, number_text(inertial.moment(i, j))});
    }
  }
  element.children.push_back(std::move(inertia));
  return element;
}

void write_light(const desc::Light& light, Element& element) {
  replace_child(element, Element{"pose", pose_text(light.pose)});
  replace_child(element, Element{"diffuse", vector_text(light.diffuse.cast<double>()) + " 1"});
  replace_child(element, Element{"cast_shadows", light.cast_shadows ? "true" : "false"});
  if (light.type != desc::Light::Type::kPoint) {
    replace_child(element, Element{"direction", vector_text(light.direction)});
  }
}

void write_link(const desc::Link& read, const desc::Link& now, Element& element) {
  if (!equal(read.inertial, now.inertial)) replace_child(element, inertial_element(now.inertial));
  if (read.gravity != now.gravity) {
    replace_child(element, Element{"gravity", now.gravity ? "true" : "false"});
  }
  for (std::size_t i = 0; i < std::min(read.lights.size(), now.lights.size()); ++i) {
    if (read.lights[i] == now.lights[i]) continue;
    for (Element& child : element.children) {
      if (child.name == "light" && name_of(child) == now.lights[i].name) {
        write_light(now.lights[i], child);
      }
    }
  }
}

bool same_limits(const desc::JointAxis& a, const desc::JointAxis& b) {
  return a.lower == b.lower && a.upper == b.upper;
}

void write_axis(const desc::JointAxis& read, const desc::JointAxis& now, Element& element) {
  if (read.damping != now.damping) {
    set_child(child_made(element, "dynamics"), "damping", number_text(now.damping));
  }
  if (same_limits(read, now)) return;
  Element& limit = child_made(element, "limit");
  set_child(limit, "lower", number_text(now.lower));
  set_child(limit, "upper", number_text(now.upper));
  if (find_child(element, "initial_position") == nullptr) return;
  set_child(element, "initial_position", number_text(now.initial_position));
}

void write_joint(const desc::Joint& read, const desc::Joint& now, Element& element) {
  for (std::size_t k = 0; k < now.axes.size(); ++k) {
    Element* axis = find_child(element, k == 0 ? "axis" : "axis2");
    if (axis != nullptr) write_axis(read.axes[k], now.axes[k], *axis);
    if (!same_limits(read.axes[k], now.axes[k]) && *element.attribute("type") == "continuous") {
      set_attribute(element, "type", "revolute");  // a continuous one has no limits
    }
  }
}

bool equal(const desc::Physics& a, const desc::Physics& b) {
  return a.iterations == b.iterations && a.erp == b.erp && a.cfm == b.cfm &&
         a.contact_max_correcting_vel == b.contact_max_correcting_vel &&
         a.contact_surface_layer == b.contact_surface_layer;
}

Element& physics_of(const desc::World& read, Element& world) {
  if (const Element* found = chosen_physics(world)) {
    return world.children[static_cast<std::size_t>(found - world.children.data())];
  }
  Element physics{"physics", "", {{"name", "default"}, {"type", "ode"}}};
  physics.children.push_back(Element{"max_step_size", number_text(to_seconds(read.physics.step))});
  physics.children.push_back(
      Element{"real_time_factor", number_text(read.physics.real_time_factor)});
  world.children.push_back(std::move(physics));
  return world.children.back();
}

}  // namespace

Element* find_part(Element& model, const std::string& element, const std::string& name) {
  const std::size_t at = name.find("::");
  for (Element& child : model.children) {
    if (at == std::string::npos && child.name == element && name_of(child) == name) return &child;
    if (at != std::string::npos && child.name == "model" && name_of(child) == name.substr(0, at)) {
      return find_part(child, element, name.substr(at + 2));
    }
  }
  return nullptr;
}

void write_changes(const desc::Model& read, const desc::Model& now, Element& model) {
  for (std::size_t i = 0; i < now.links.size(); ++i) {
    if (Element* link = find_part(model, "link", now.links[i].name)) {
      write_link(read.links[i], now.links[i], *link);
    }
    // A service takes moments that no body has, a file does not.
    const bool loads = now.is_static || is_possible(now.links[i].inertial);
    if (!loads) set_attribute(model, kStrict, "false");
  }
  for (std::size_t i = 0; i < now.joints.size(); ++i) {
    Element* joint = find_part(model, "joint", now.joints[i].name);
    if (joint != nullptr) write_joint(read.joints[i], now.joints[i], *joint);
  }
}

void write_lamp(const LightState& light, Element& holder) {
  for (Element& child : holder.children) {
    if (child.name != "light" || name_of(child) != light.light->name) continue;
    for (const Element& param : light.lamp.children) {
      set_child(child, "angen:" + param.name, param.text);
    }
  }
}

void write_lights(const desc::World& read, const std::vector<LightState>& now, Element& world) {
  const auto state_of = [&](const Element& element) {
    return std::find_if(now.begin(), now.end(), [&](const LightState& state) {
      return state.sdf.empty() && state.light->name == name_of(element);
    });
  };
  std::vector<Element>& parts = world.children;
  erase_if(parts, [&](const Element& part) {
    return part.name == "light" && state_of(part) == now.end();
  });
  for (Element& part : parts) {
    if (part.name != "light") continue;
    const desc::Light& light = *state_of(part)->light;
    for (const desc::Light& before : read.lights) {
      if (before.name == light.name && !(before == light)) write_light(light, part);
    }
  }
  for (const LightState& state : now) {
    if (!state.sdf.empty()) {
      parts.push_back(light_element(state.sdf, state.light->name));
      write_light(*state.light, parts.back());
    }
    write_lamp(state, world);
  }
}

void write_settings(const desc::World& read, const WorldState& now, Element& world) {
  if (now.gravity != read.gravity) {
    replace_child(world, Element{"gravity", vector_text(now.gravity)});
  }
  if (equal(now.physics, read.physics)) return;
  Element& ode = child_made(physics_of(read, world), "ode");
  set_child(child_made(ode, "solver"), "iters", std::to_string(now.physics.iterations));
  Element& constraints = child_made(ode, "constraints");
  set_child(constraints, "erp", number_text(now.physics.erp));
  set_child(constraints, "cfm", number_text(now.physics.cfm));
  set_child(constraints, "contact_max_correcting_vel",
            number_text(now.physics.contact_max_correcting_vel));
  set_child(constraints, "contact_surface_layer", number_text(now.physics.contact_surface_layer));
}

}  // namespace angen::load
