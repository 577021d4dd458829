#include "load/describe.h"

#include "core/text.h"
#include "load/geometry.h"
#include "load/light.h"
#include "load/material.h"
#include "load/values.h"
#include "load/xml.h"

namespace angen::load {

namespace {

struct Place {
  std::string prefix;  // of names in a nested model
  Pose pose;           // the nested model's frame in the outermost one's
  bool never_moves = false;
};

std::optional<double> optional_number(const Element* parent, const std::string& name) {
  const Element* child = parent == nullptr ? nullptr : parent->child(name);
  if (child == nullptr) return std::nullopt;
  return number_of(*child);
}

const Element* walk(const Element& from, std::initializer_list<const char*> path) {
  const Element* at = &from;
  for (const char* name : path) {
    at = at == nullptr ? nullptr : at->child(name);
  }
  return at;
}

void read_surface(const Element& element, desc::Collision& collision) {
  if (const Element* ode = walk(element, {"surface", "friction", "ode"})) {
    desc::Friction& friction = collision.friction;
    friction.mu = child_number(*ode, "mu", friction.mu);
    friction.mu2 = child_number(*ode, "mu2", friction.mu2);
    friction.slip1 = child_number(*ode, "slip1", friction.slip1);
    friction.slip2 = child_number(*ode, "slip2", friction.slip2);
    if (const Element* direction = ode->child("fdir1")) {
      const std::vector<double> v = numbers_of(*direction, 3);
      friction.direction1 = Vec3(v[0], v[1], v[2]).normalized();
    }
  }
  if (const Element* bounce = walk(element, {"surface", "bounce"})) {
    collision.restitution = child_number(*bounce, "restitution_coefficient", 0.0);
  }
  const Element* contact = walk(element, {"surface", "contact", "ode"});
  collision.stiffness = optional_number(contact, "kp");
  collision.damping = optional_number(contact, "kd");
}

// `part` once for each shape of its geometry: several are called NAME_0, NAME_1, …
template <class Part>
void add_shapes(const Element& element, const sdf::SemanticPose& pose, Part part, Session& session,
                std::vector<Part>& to) {
  const std::vector<PlacedShape> shapes =
      shapes_of(*element.child("geometry"), resolve(pose, "", element.source), session);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    part.name = name_of(element) + (shapes.size() == 1 ? "" : "_" + std::to_string(i));
    part.shape = shapes[i].shape;
    part.pose = shapes[i].pose;
    to.push_back(part);
  }
}

void add_collisions(const Element& element, const sdf::Collision& from, Session& session,
                    desc::Link& link) {
  desc::Collision collision;
  collision.source = element.source;
  read_surface(element, collision);
  add_shapes(element, from.SemanticPose(), collision, session, link.collisions);
}

// As gz-sim's Thermal system has it: <plugin filename="gz-sim-thermal-system"><temperature>.
std::optional<double> temperature_of(const Element& visual) {
  for (const Element& plugin : visual.children) {
    const std::string* file = plugin.attribute("filename");
    if (plugin.name != "plugin" || file == nullptr) continue;
    if (file->find("thermal-system") == std::string::npos) continue;
    const Element* given = plugin.child("temperature");
    if (given == nullptr) continue;
    const double kelvin = number_of(*given);
    if (!(kelvin > 0.0)) {
      throw Error(given->source,
                  "<temperature> is " + number_text(kelvin) + " K; it must be greater than 0");
    }
    return kelvin;
  }
  return std::nullopt;
}

void add_visuals(const Element& element, const sdf::Visual& from, Session& session,
                 desc::Link& link) {
  desc::Visual visual;
  visual.material = material_of(element, session);
  visual.temperature = temperature_of(element);
  add_shapes(element, from.SemanticPose(), visual, session, link.visuals);
}

template <class T>
const T& need(const T* found, const Element& element) {
  if (found == nullptr) throw Error(element.source, "libsdformat does not read " + tag_of(element));
  return *found;
}

desc::Link link_of(const Element& element, const sdf::Link& from, const Place& place,
                   Session& session) {
  desc::Link link;
  link.name = place.prefix + name_of(element);
  link.source = element.source;
  link.pose = place.pose * resolve(from.SemanticPose(), "__model__", element.source);
  link.inertial = inertial_of(element, place.never_moves, session);
  link.gravity = child_flag(element, "gravity", true);
  link.kinematic = child_flag(element, "kinematic", false);
  for (const Element& part : element.children) {
    const std::string name = name_of(part);
    if (part.name == "collision") {
      add_collisions(part, need(from.CollisionByName(name), part), session, link);
    } else if (part.name == "visual") {
      add_visuals(part, need(from.VisualByName(name), part), session, link);
    } else if (part.name == "sensor") {
      const sdf::Sensor& sensor = need(from.SensorByName(name), part);
      link.sensors.push_back(
          sensor_of(part, resolve(sensor.SemanticPose(), "", part.source), session));
    } else if (part.name == "light") {
      const sdf::Light& light = need(from.LightByName(name), part);
      link.lights.push_back(light_of(part, resolve(light.SemanticPose(), "", part.source)));
    }
  }
  return link;
}

void add_parts(const Element& element, const sdf::Model& from, const Place& place, desc::Model& to,
               Session& session) {
  for (const Element& part : element.children) {
    const std::string name = name_of(part);
    if (part.name == "link") {
      to.links.push_back(link_of(part, need(from.LinkByName(name), part), place, session));
    } else if (part.name == "joint") {
      to.joints.push_back(
          joint_of(part, need(from.JointByName(name), part), place.prefix, place.pose));
    } else if (part.name == "plugin") {
      to.plugins.push_back(plugin_of(part));
    } else if (part.name == "model") {
      const sdf::Model& nested = need(from.ModelByName(name), part);
      Place inner = place;
      inner.prefix += name + "::";
      inner.pose = place.pose * resolve(nested.SemanticPose(), "__model__", part.source);
      add_parts(part, nested, inner, to, session);
    }
  }
}

desc::Model described_model(const Element& model, const sdf::Model& from, Session& session) {
  desc::Model to;
  to.is_static = child_flag(model, "static", false);
  to.allow_auto_disable = child_flag(model, "allow_auto_disable", true);
  to.self_collide = child_flag(model, "self_collide", false);
  Place place;
  place.never_moves = to.is_static;
  add_parts(model, from, place, to, session);
  merge_hinges(to, session);
  return to;
}

}  // namespace

desc::Plugin plugin_of(const Element& element) {
  const std::string file = *element.attribute("filename");
  const std::string name = name_of(element);
  return {name.empty() ? file : name, file, element, element.source};
}

desc::Sensor sensor_of(const Element& element, const Pose& pose, Session& session) {
  desc::Sensor sensor;
  sensor.name = name_of(element);
  sensor.type = *element.attribute("type");
  sensor.pose = pose;
  sensor.update_rate = child_number(element, "update_rate", 0.0);
  sensor.visualize = child_flag(element, "visualize", false);
  sensor.element = element;
  sensor.source = element.source;
  for (const Element& child : element.children) {
    if (child.name != "plugin") continue;
    if (!sensor.plugin.empty()) {
      session.warn(child.source, "a second <plugin> in " + tag_of(element) + " has no effect");
      continue;
    }
    sensor.plugin = *child.attribute("filename");
    sensor.plugin_element = child;
  }
  if (sensor.plugin.empty()) {
    session.warn(element.source, tag_of(element) +
                                     " has no <plugin>, so nothing reads it; give it "
                                     "one, such as filename=\"libpir_controller.so\"");
  }
  return sensor;
}

std::vector<desc::Model> describe_models(const std::vector<Element>& models, Session& session) {
  std::vector<desc::Model> described;
  if (models.empty()) return described;
  Element world;
  world.name = "world";
  world.source = models.front().source;
  world.attributes = {{"name", "default"}};
  world.children = models;
  for (Element& model : world.children) remove_children(model, "pose");
  const Memory memory;
  const Hush hush;
  const sdf::Root root = parse_world(world, session);
  for (const Element& model : models) {
    described.push_back(described_model(
        model, need(root.WorldByIndex(0)->ModelByName(name_of(model)), model), session));
  }
  return described;
}

}  // namespace angen::load
