#include "sdf/ignored.h"

#include <map>
#include <set>

#include "document/tolerance.h"
#include "document/xml.h"
#include "import/urdf.h"
#include "sdf/describe.h"

namespace angen::load {

namespace {

using Names = std::set<std::string>;

/// What is read of an element; attributes besides `name`, which every element may have.
struct Used {
  Names children;
  Names attributes = {};
};

// By "parent/element" where the name alone does not say which it is.
const std::map<std::string, Used>& table() {
  static const Used axis{{"xyz", "limit", "dynamics", "initial_position", kSafety}};
  static const std::map<std::string, Used> used = {
      {"world",
       {{"gravity", "physics", "scene", "atmosphere", "light", "frame", "model", "actor", "include",
         "plugin", "state"}}},
      {"physics",
       {{"max_step_size", "real_time_factor", "real_time_update_rate", "ode"},
        {"type", "default"}}},
      {"physics/ode", {{"solver", "constraints"}}},
      {"solver", {{"iters"}}},
      {"constraints", {{"cfm", "erp", "contact_max_correcting_vel", "contact_surface_layer"}}},
      {"scene", {{"ambient", "background", "shadows"}}},
      {"atmosphere", {{"temperature"}, {"type"}}},
      {"state", {{"model"}, {"world_name"}}},
      {"state/model", {{"pose", "joint"}}},
      {"saved/joint", {{"angle"}}},
      {"angle", {{}, {"axis"}}},
      {"light",
       {{"pose", "diffuse", "intensity", "cast_shadows", "attenuation", "direction", "spot",
         "angen:rectangle", "angen:disc", "angen:sphere", "angen:tube", "angen:half_angle",
         "angen:ies", "angen:color_temperature", "angen:level"},
        {"type"}}},
      {"angen:ies", {{"uri"}}},
      {"attenuation", {{"range"}}},
      {"spot", {{"inner_angle", "outer_angle"}}},
      {"model",
       {{"static", "self_collide", "allow_auto_disable", "pose", "link", "joint", "frame", "model",
         "include", "plugin"},
        {"canonical_link", "placement_frame", "version"}}},
      {"frame", {{"pose"}, {"attached_to"}}},
      {"pose", {{}, {"relative_to", "degrees", "rotation_format"}}},
      {"link",
       {{"pose", "inertial", "gravity", "kinematic", "self_collide", "collision", "visual",
         "sensor", "light"}}},
      {"inertial", {{"mass", "pose", "inertia"}}},
      {"inertia", {{"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}}},
      {"collision", {{"pose", "geometry", "surface"}}},
      {"visual", {{"pose", "geometry", "material", "transparency", "plugin"}}},
      {"material", {{"script", "diffuse", "ambient", "emissive"}}},
      {"material/script", {{"uri", "name"}}},
      {"geometry",
       {{"empty", "box", "sphere", "cylinder", "capsule", "plane", "mesh", "heightmap", "image"}}},
      {"box", {{"size"}}},
      {"sphere", {{"radius"}}},
      {"cylinder", {{"radius", "length"}}},
      {"capsule", {{"radius", "length"}}},
      {"plane", {{"normal", "size"}}},
      {"mesh", {{"uri", "scale", "submesh"}}},
      {"submesh", {{"name", "center"}}},
      {"heightmap", {{"uri", "size", "pos"}}},
      {"image", {{"uri", "scale", "threshold", "granularity", "height"}}},
      {"surface", {{"friction", "bounce", "contact"}}},
      {"friction", {{"ode"}}},
      {"friction/ode", {{"mu", "mu2", "fdir1", "slip1", "slip2"}}},
      {"bounce", {{"restitution_coefficient"}}},
      {"contact", {{"ode"}}},
      {"contact/ode", {{"kp", "kd", "min_depth"}}},
      {"joint", {{"parent", "child", "pose", "axis", "axis2"}, {"type"}}},
      {"axis", axis},
      {"axis2", axis},
      {"xyz", {{}, {"expressed_in"}}},
      {"limit", {{"lower", "upper", "effort", "velocity"}}},
      {"dynamics", {{"damping", "friction", "spring_stiffness", "spring_reference"}}},
      {kSafety, {{"soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"}}},
      {"sensor/ray", {{"scan", "range", "noise"}}},
      {"scan", {{"horizontal", "vertical"}}},
      {"horizontal", {{"samples", "min_angle", "max_angle"}}},
      {"vertical", {{"samples", "min_angle", "max_angle"}}},
      {"ray/range", {{"min", "max"}}},
      {"ray/noise", {{"type", "mean", "stddev"}}},
      {"sensor/camera", {{"pose", "horizontal_fov", "image", "clip", "distortion"}, {"name"}}},
      {"camera/image", {{"width", "height", "format"}}},
      {"distortion", {{"k1", "k2", "k3", "p1", "p2"}}},
      {"clip", {{"near", "far"}}},
      {"sensor/contact", {{"collision"}}},
      {"actor", {{"pose", "script", "plugin"}}},
      {"script", {{"loop", "delay_start", "auto_start", "trajectory"}}},
      {"trajectory", {{"waypoint"}, {"id"}}},
      {"waypoint", {{"time", "pose"}}},
  };
  return used;
}

// What has had its own warning.
bool has_warning(const std::string& name) {
  static const Names warned = {"gripper", "projector", "battery"};
  return warned.count(name) != 0;
}

const Used* used_of(const Element& element, const std::string& parent) {
  const auto exact = table().find(parent + "/" + element.name);
  if (exact != table().end()) return &exact->second;
  const auto found = table().find(element.name);
  return found == table().end() ? nullptr : &found->second;
}

// Axes that a joint of its type does not have, and springs of one that has two.
bool has_no_use(const Element& joint, const Element& child) {
  const std::string* type = joint.attribute("type");
  if (type == nullptr) return false;
  if (child.name == "axis") return *type == "fixed" || *type == "ball";
  return child.name == "axis2" && *type != "universal";
}

void walk(const Element& element, const std::string& parent, bool springs, Session& session);

// What Angen's own plug-ins read of SDF's blocks; of anything else a plug-in may make something.
void walk_sensor(const Element& sensor, Session& session) {
  for (const Element& child : sensor.children) {
    if (child.name == "always_on" || child.name == "enable_metrics") {
      session.ignore(child.source, "<" + child.name + "> in <sensor>");
    }
    const bool known = table().count("sensor/" + child.name) != 0;
    if (known) walk(child, "sensor", true, session);
  }
}

void walk(const Element& element, const std::string& parent, bool springs, Session& session) {
  static const Used value{};
  const Used* found = used_of(element, parent);
  const Used* used = found == nullptr ? &value : found;
  for (const auto& [name, value] : element.attributes) {
    if (name == "name" || name == kStrict || used->attributes.count(name) != 0) continue;
    std::string what = name;
    what.append("=\"").append(value).append("\" of <").append(element.name).append(">");
    session.ignore(element.source, what);
  }
  const std::string* type = element.attribute("type");
  if (element.name == "joint" && type != nullptr) springs = *type != "universal";
  for (const Element& child : element.children) {
    const bool unused = used->children.count(child.name) == 0 ||
                        (element.name == "joint" && has_no_use(element, child)) ||
                        (!springs && child.name.compare(0, 7, "spring_") == 0);
    if (unused && !has_warning(child.name)) {
      session.ignore(child.source, "<" + child.name + "> in <" + element.name + ">");
    }
    if (unused || child.name == "plugin") continue;  // plug-ins say what they do not know
    if (child.name == "sensor") {
      walk_sensor(child, session);
      continue;
    }
    walk(child, parent == "state" ? "saved" : element.name, springs, session);
  }
}

}  // namespace

void note_ignored(const Element& element, Session& session) { walk(element, "", true, session); }

}  // namespace angen::load
