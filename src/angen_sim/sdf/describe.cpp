#include "sdf/describe.h"

#include <algorithm>

#include "core/limits.h"
#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/check.h"
#include "sdf/geometry.h"
#include "sdf/light.h"
#include "sdf/material.h"
#include "sdf/schema.h"
#include "sdf/surface.h"

namespace angen::load {

namespace {

// What a model's parts are described with.
struct Context {
  Frames& frames;    // of the outermost model
  bool never_moves;  // it is static
  Session& session;
  bool held = false;  // it is static within one that moves
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
  collision.min_depth = optional_number(contact, "min_depth");
}

// `part` once for each shape of its geometry: several are called NAME_0, NAME_1, …
template <class Part>
std::vector<PlacedShape> add_shapes(const Element& element, const Pose& pose, Part part,
                                    Session& session, std::vector<Part>& to) {
  std::vector<PlacedShape> shapes = shapes_of(*element.child("geometry"), pose, session);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    part.name = name_of(element) + (shapes.size() == 1 ? "" : "_" + std::to_string(i));
    part.shape = shapes[i].shape;
    part.pose = shapes[i].pose;
    to.push_back(part);
  }
  return shapes;
}

void add_collisions(const Element& element, const Pose& pose, Session& session, desc::Link& link) {
  desc::Collision collision;
  collision.source = element.source;
  read_surface(element, collision);
  add_shapes(element, pose, collision, session, link.collisions);
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
    const std::string wrong = kelvin > 0.0 ? limit_problem(limits::kTemperature, kelvin, true)
                                           : "it must be greater than 0";
    if (!wrong.empty()) {
      throw Error(given->source, "<temperature> is " + number_text(kelvin) + " K; " + wrong);
    }
    return kelvin;
  }
  return std::nullopt;
}

void add_visuals(const Element& element, const Pose& pose, Session& session, desc::Link& link) {
  desc::Visual visual;
  visual.material = material_of(element, session);
  visual.temperature = temperature_of(element);
  const std::vector<PlacedShape> shapes = add_shapes(element, pose, visual, session, link.visuals);
  if (element.child("material") != nullptr) return;
  paint(shapes.back(), element.source, session, link.visuals.back().material);
}

// Where a <camera> of several is on its sensor.
Pose pose_of(const Element& camera) {
  Pose pose;
  const Element* given = camera.child("pose");
  if (given == nullptr) return pose;
  const std::vector<double> v = numbers_of(*given, 6);
  pose.position = {v[0], v[1], v[2]};
  pose.rotation = from_rpy(v[3], v[4], v[5]);
  return pose;
}

// A multicamera is as many cameras, each with its topics below its name. As in Gazebo, only the
// right one of a pair has a baseline.
std::vector<desc::Sensor> sensors_of(const Element& element, const Pose& pose, Session& session) {
  const desc::Sensor all = sensor_of(element, pose, session);
  if (all.type != "multicamera") return {all};
  std::vector<desc::Sensor> sensors;
  for (const Element& camera : element.children) {
    if (camera.name != "camera") continue;
    desc::Sensor one = all;
    const std::string name = name_of(camera);
    one.name = all.name + "_" + name;
    one.type = "camera";
    one.pose = pose * pose_of(camera);
    remove_children(one.element, "camera");
    one.element.children.push_back(camera);
    std::string scoped = all.plugin_element.child_text("cameraName");
    if (!scoped.empty()) scoped += "/";
    set_child(one.plugin_element, "cameraName", scoped.append(name));
    if (name.find("right") == std::string::npos) {
      remove_children(one.plugin_element, "hackBaseline");
    }
    sensors.push_back(std::move(one));
  }
  return sensors;
}

desc::Link link_of(const Element& element, const std::string& scope, const Context& context) {
  desc::Link link;
  link.name = scope + name_of(element);
  link.source = element.source;
  link.pose = context.frames.pose(link.name);
  link.inertial = inertial_of(element, context.never_moves, context.session);
  link.gravity = child_flag(element, "gravity", true);
  link.kinematic = child_flag(element, "kinematic", false) || context.held;
  if (element.child("self_collide") != nullptr) {
    link.self_collide = child_flag(element, "self_collide", false);
  }
  const auto place = [&](const Element& part) {
    return context.frames.part_pose(part, link.name, scope);
  };
  for (const Element& part : element.children) {
    if (part.name == "collision") {
      add_collisions(part, place(part), context.session, link);
    } else if (part.name == "visual") {
      add_visuals(part, place(part), context.session, link);
    } else if (part.name == "sensor") {
      for (desc::Sensor& sensor : sensors_of(part, place(part), context.session)) {
        link.sensors.push_back(std::move(sensor));
      }
    } else if (part.name == "light") {
      link.lights.push_back(light_of(part, place(part), context.session));
    }
  }
  return link;
}

void add_parts(const Element& element, const std::string& scope, const Context& context,
               desc::Model& to) {
  for (const Element& part : element.children) {
    if (part.name == "link") {
      to.links.push_back(link_of(part, scope, context));
    } else if (part.name == "joint") {
      to.joints.push_back(joint_of(part, scope, context.frames));
    } else if (part.name == "plugin") {
      to.plugins.push_back(plugin_of(part));
    } else if (part.name == "model") {
      Context inner = context;
      inner.held = context.held || (!context.never_moves && child_flag(part, "static", false));
      inner.never_moves = context.never_moves || inner.held;
      add_parts(part, scope + name_of(part) + "::", inner, to);
    }
  }
}

// Also where every model in it that has links is static.
bool is_static(const Element& model) {
  if (child_flag(model, "static", false)) return true;
  const auto& parts = model.children;
  return has_link(model) && std::all_of(parts.begin(), parts.end(), [](const Element& part) {
           return part.name != "link" &&
                  (part.name != "model" || !has_link(part) || is_static(part));
         });
}

desc::Model described_model(const Element& model, Session& session) {
  desc::Model to;
  to.is_static = is_static(model);
  to.allow_auto_disable = child_flag(model, "allow_auto_disable", true);
  to.self_collide = child_flag(model, "self_collide", false);
  Frames frames(model);
  add_parts(model, "", {frames, child_flag(model, "static", false), session}, to);
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
  check_schema(world, session);
  for (const Element& model : models) described.push_back(described_model(model, session));
  return described;
}

}  // namespace angen::load
