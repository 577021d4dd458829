#include "sdf/describe.h"

#include <algorithm>

#include "core/limits.h"
#include "core/text.h"
#include "document/dialect.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/check.h"
#include "sdf/geometry.h"
#include "sdf/home.h"

namespace angen::load {

namespace {

// The context in which a model's parts are described.
struct Context {
  Frames& frames;    // frames of the outermost model
  bool never_moves;  // it is static
  Session& session;
  bool held = false;  // it is static within one that moves
};

void read_surface(const Reader& surface, desc::Collision& collision) {
  const Reader ode = surface.block("friction").block("ode");
  desc::Friction& friction = collision.friction;
  friction.mu = ode.number("mu", friction.mu, Range::not_negative(kFinite));
  friction.mu2 = ode.number("mu2", friction.mu2, Range::not_negative(kFinite));
  friction.slip1 = ode.number("slip1", friction.slip1, Range::solver(0.0, 1e9));
  friction.slip2 = ode.number("slip2", friction.slip2, Range::solver(0.0, 1e9));
  const std::vector<double> v = ode.numbers("fdir1", 3, Range::any(limits::kDirection));
  if (!v.empty()) friction.direction1 = Vec3(v[0], v[1], v[2]).normalized();
  collision.restitution =
      surface.block("bounce").number("restitution_coefficient", 0.0, Range::solver(0.0, 1.0));
  const Reader contact = surface.block("contact").block("ode");
  collision.stiffness = contact.number("kp", Range::solver(1e-6, 1e16, Range::Sign::kPositive));
  collision.damping = contact.number("kd", Range::solver(0.0, 1e16));
  collision.min_depth = contact.number("min_depth", Range::solver(0.0, 1.0));
}

// `part` once for each shape of its geometry: several are called NAME_0, NAME_1, …
template <class Part>
std::vector<PlacedShape> add_shapes(const Reader& element, const Pose& pose, Part part,
                                    Session& session, std::vector<Part>& to) {
  std::vector<PlacedShape> shapes = shapes_of(element, pose, session);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    part.name = name_of(element.element()) + (shapes.size() == 1 ? "" : "_" + std::to_string(i));
    part.shape = shapes[i].shape;
    part.pose = shapes[i].pose;
    to.push_back(part);
  }
  return shapes;
}

void add_collisions(const Element& element, const Pose& pose, Session& session, desc::Link& link) {
  desc::Collision collision;
  const Reader reader(element, session);
  collision.source = element.source;
  read_surface(reader.block("surface"), collision);
  add_shapes(reader, pose, collision, session, link.collisions);
}

// Given like gz-sim's Thermal system: <plugin filename="gz-sim-thermal-system"><temperature>.
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
  const Reader reader(element, session);
  desc::Visual visual;
  visual.material = material_of(reader, session);
  visual.temperature = temperature_of(element);
  reader.note({"plugin"});
  const std::vector<PlacedShape> shapes = add_shapes(reader, pose, visual, session, link.visuals);
  if (element.child("material") != nullptr) return;
  paint(shapes.back(), element.source, session, link.visuals.back().material);
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
    one.pose = pose * child_pose(camera);
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
  const Reader reader(element, context.session);
  desc::Link link;
  link.name = scope + name_of(element);
  link.source = element.source;
  link.pose = context.frames.pose(link.name);
  link.inertial = inertial_of(reader, context.never_moves, context.session);
  link.gravity = reader.flag("gravity", true);
  link.kinematic = reader.flag("kinematic", false) || context.held;
  if (reader.child("self_collide") != nullptr) {
    link.self_collide = reader.flag("self_collide", false);
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

void add_parts(const Reader& model, const std::string& scope, const Context& context,
               desc::Model& to) {
  Session& session = context.session;
  for (const char* read_by_frames : {"canonical_link", "placement_frame", "version"}) {
    model.attribute(read_by_frames);
  }
  model.note({"plugin"});
  const Pose frame =
      scope.empty() ? Pose{} : context.frames.pose(scope.substr(0, scope.size() - 2));
  read_home_parts(model, frame, to.home, session);
  for (const Element& part : model.element().children) {
    if (part.name == "link") {
      to.links.push_back(link_of(part, scope, context));
    } else if (part.name == "joint") {
      to.joints.push_back(joint_of(part, scope, context.frames, session));
    } else if (part.name == "frame") {
      Reader(part, session).attribute("attached_to");
    } else if (part.name == "plugin") {
      to.plugins.push_back(plugin_of(part));
    } else if (part.name == "model") {
      const Reader reader(part, session);
      Context inner = context;
      inner.held = context.held || (reader.flag("static", false) && !context.never_moves);
      inner.never_moves = context.never_moves || inner.held;
      add_parts(reader, scope + name_of(part) + "::", inner, to);
    } else if (part.name == "gripper" || part.name == "projector" || part.name == "battery") {
      session.warn(part.source, "<" + part.name + "> has no effect");
      session.read[&part] = Session::Mark::kWarned;
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

// There is one range for each ray.
void note_resolution(const Reader& axis) {
  const Element* given = axis ? axis.element().child("resolution") : nullptr;
  const bool one = given != nullptr && parse_finite(given->text) == 1.0;
  (one ? axis : axis.unused()).number("resolution");
}

// The values that Angen's own plug-ins read of SDF's blocks; those of others may read more.
void check_blocks(const Reader& sensor, Session& session) {
  sensor.leave_to_others();
  const Element* always_on = sensor.element().child("always_on");  // the default
  (always_on != nullptr && flag_of(*always_on) ? sensor : sensor.unused()).flag("always_on", false);
  sensor.unused().child("enable_metrics");
  const auto check = [](const Reader& block, std::initializer_list<const char*> keys,
                        const Range& range = {}) {
    for (const char* key : keys) block.number(key, range);
  };
  for (const Element& child : sensor.element().children) {
    if (child.name != "ray" && child.name != "camera" && child.name != "contact") continue;
    const Reader block(child, session);
    if (child.name == "contact") block.note({"collision"});
    if (child.name == "ray") {
      const Reader scan = block.block("scan");
      for (const char* axis : {"horizontal", "vertical"}) {
        check(scan.block(axis), {"samples", "min_angle", "max_angle"});
        note_resolution(scan.block(axis));
      }
      check(block.block("range"), {"min", "max"});
      block.block("noise").note({"type"});
      check(block.block("noise"), {"mean", "stddev"});
    } else if (child.name == "camera") {
      check(block, {"horizontal_fov"}, Range::positive());
      block.block("image").note({"format"});
      check(block.block("image"), {"width", "height"}, Range::positive());
      check(block.block("clip"), {"near", "far"}, Range::positive());
      check(block.block("distortion"), {"k1", "k2", "k3", "p1", "p2"});
    }
  }
}

}  // namespace

desc::Plugin plugin_of(const Element& element) {
  const std::string file = *element.attribute("filename");
  const std::string name = name_of(element);
  return {name.empty() ? file : name, file, element, element.source, made_for_gazebo(file)};
}

desc::Sensor sensor_of(const Element& element, const Pose& pose, Session& session) {
  const Reader reader(element, session);
  desc::Sensor sensor;
  sensor.name = name_of(element);
  sensor.type = *element.attribute("type");
  sensor.pose = pose;
  sensor.update_rate = reader.number("update_rate", 0.0, Range::not_negative());
  sensor.visualize = reader.flag("visualize", false);
  check_blocks(reader, session);
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

desc::Model describe_model(const Element& model, Session& session) {
  const Reader reader(model, session);
  desc::Model to;
  to.is_static = is_static(model);
  to.allow_auto_disable = reader.flag("allow_auto_disable", true);
  to.self_collide = reader.flag("self_collide", false);
  Frames frames(model);
  const std::string placed = model.attribute_text("placement_frame");
  if (!placed.empty()) to.placed = frames.pose(placed);
  add_parts(reader, "", {frames, reader.flag("static", false), session}, to);
  merge_hinges(to, session);
  note_ignored(model, session);
  return to;
}

}  // namespace angen::load
