#include "sdf/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/limits.h"
#include "core/names.h"
#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/upgrade.h"

namespace angen::load {

bool has_link(const Element& model) {
  for (const Element& child : model.children) {
    if (child.name == "link" || (child.name == "model" && has_link(child))) return true;
  }
  return false;
}

namespace {

const std::set<std::string> kJoints = {"fixed", "revolute",  "continuous", "prismatic",
                                       "ball",  "universal", "screw"};
const std::set<std::string> kLights = {"point", "spot", "directional"};

std::string listed(const std::set<std::string>& names) {
  return join_names({names.begin(), names.end()});
}

// Joints have names of their own in URDF.
void check_children_names(const Element& parent, const Session& session) {
  std::map<std::pair<std::string, std::string>, Source> seen;
  for (const Element& child : parent.children) {
    std::string space = names_shared_by(child);
    if (space.empty()) continue;
    const bool is_own =
        session.dialect->names_joints_apart() || session.converted.count(child.source.file) != 0;
    if (is_own && child.name == "joint") space = child.name;
    const std::string name = name_of(child);
    check_name(name, "<" + child.name + ">", child.source);
    const auto [there, fresh] = seen.insert({{space, name}, child.source});
    if (!fresh) {
      throw Error(child.source, "the name '" + name + "' is given twice in " + tag_of(parent) +
                                    ", first at line " + std::to_string(there->second.line) +
                                    "; give <" + child.name + "> another name");
    }
  }
}

void check_plugin(const Element& plugin) {
  if (plugin.attribute_text("filename").empty()) {
    throw Error(plugin.source, "<plugin> has no filename; write filename=\"libNAME.so\"");
  }
  const std::string problem = label_problem(name_of(plugin));
  if (!problem.empty()) throw Error(plugin.source, "<plugin>: " + problem);
}

void need_type(const Element& element, const std::string& right, Session& session) {
  if (element.attribute("type") != nullptr) return;
  session.warn_or_throw(Error(element.source, tag_of(element) + " has no type; write " + right));
}

void check_light(const Element& light) {
  const std::string* type = light.attribute("type");
  if (type != nullptr && kLights.count(*type) == 0) {
    throw Error(light.source,
                "unknown light type '" + printable(*type) + "'; known are " + listed(kLights));
  }
}

void check_typed_light(const Element& light, Session& session) {
  need_type(light, "type=\"point\"", session);
  check_light(light);
}

void check_sensor(const Element& sensor) {
  if (sensor.attribute_text("type").empty()) {
    throw Error(sensor.source, tag_of(sensor) + " has no type; write type=\"ray\"");
  }
}

void check_link(const Element& link, Session& session) {
  check_children_names(link, session);
  for (const Element& child : link.children) {
    if (child.name == "light") check_typed_light(child, session);
    if (child.name != "sensor") continue;
    check_sensor(child);
    for (const Element& part : child.children) {
      if (part.name == "plugin") check_plugin(part);
    }
  }
}

// Links, frames and nested models, the latter with their own after "::".
void collect_frames(const Element& model, const std::string& prefix, std::set<std::string>& names) {
  for (const Element& child : model.children) {
    if (child.name == "link" || child.name == "frame" || child.name == "joint" ||
        child.name == "model") {
      names.insert(prefix + name_of(child));
    }
    if (child.name == "model") collect_frames(child, prefix + name_of(child) + "::", names);
  }
}

bool is_known_end(const Element& end, const std::set<std::string>& known) {
  return known.count(end.text) != 0 || end.text == "__model__" ||
         (end.name == "parent" && end.text == "world");
}

void check_joint_end(const Element& joint, const std::string& end,
                     const std::set<std::string>& known) {
  const Element* element = joint.child(end);
  if (element == nullptr || element->text.empty()) {
    throw Error(joint.source, tag_of(joint) + " has no <" + end + ">; name a link");
  }
  if (is_known_end(*element, known)) return;
  throw Error(element->source, tag_of(joint) + " names an unknown link '" +
                                   printable(element->text) + "'; known are " +
                                   join_names({known.begin(), known.end()}));
}

bool zero_axis(const Element& axis) {
  const Element* xyz = axis.child("xyz");
  if (xyz == nullptr) return false;
  for (const double v : numbers_of(*xyz, 3)) {
    if (v != 0.0) return false;
  }
  return true;
}

// Values of ODE's joints before anything sets them, which Gazebo then takes.
const char* default_axis(const std::string& name) { return name == "axis" ? "1 0 0" : "0 1 0"; }

Error axis_is_missing(const Element& joint, const std::string& name) {
  return Error(joint.source, tag_of(joint) + " is " + *joint.attribute("type") + " and has no <" +
                                 name + ">, which is " + default_axis(name) +
                                 " in Gazebo; write <" + name + "><xyz>0 0 1</xyz></" + name + ">");
}

void add_default_axis(Element& joint, const std::string& name) {
  Element direction{"xyz", default_axis(name), {}, {}, joint.source};
  joint.children.push_back({name, "", {}, {std::move(direction)}, joint.source});
}

void check_axes(Element& joint, Session& session) {
  const std::string type = *joint.attribute("type");
  const bool turns = type == "revolute" || type == "continuous";
  for (const char* name : {"axis", "axis2"}) {
    const Element* axis = joint.child(name);
    const bool needed = std::string(name) == "axis"
                            ? turns || type == "prismatic" || type == "universal" || type == "screw"
                            : type == "universal";
    if (axis == nullptr && needed) {
      session.warn_or_throw(axis_is_missing(joint, name));
      add_default_axis(joint, name);
      continue;
    }
    if (axis == nullptr || !zero_axis(*axis)) continue;
    if (turns) {
      session.warn(axis->source, tag_of(joint) +
                                     " turns about an axis of length 0 and is taken as "
                                     "fixed; write type=\"fixed\"");
      set_attribute(joint, "type", "fixed");
      remove_children(joint, "axis");
    } else if (needed) {
      throw Error(axis->source, "the <" + std::string(name) + "> of " + tag_of(joint) +
                                    " has length 0; give it a direction such as 0 0 1");
    }
    return;
  }
}

void check_joint(Element& joint, const std::set<std::string>& known, Session& session) {
  const std::string* type = joint.attribute("type");
  if (type == nullptr || kJoints.count(*type) == 0) {
    throw Error(joint.source, type == nullptr
                                  ? tag_of(joint) + " has no type; known are " + listed(kJoints)
                                  : "unknown joint type '" + printable(*type) + "'; known are " +
                                        listed(kJoints));
  }
  check_joint_end(joint, "parent", known);
  check_joint_end(joint, "child", known);
  const std::string link = joint.child_text("child");
  if (link == joint.child_text("parent")) {
    throw Error(joint.source,
                tag_of(joint) + " joins '" + printable(link) + "' to itself; name two links");
  }
  check_axes(joint, session);
}

void check_model_parts(Element& model, Session& session) {
  std::set<std::string> known;
  collect_frames(model, "", known);
  if (!has_link(model)) throw Error(model.source, tag_of(model) + " has no <link>; give it one");
  check_children_names(model, session);
  for (Element& child : model.children) {
    if (child.name == "link") check_link(child, session);
    if (child.name == "joint") check_joint(child, known, session);
    if (child.name == "plugin") check_plugin(child);
    if (child.name == "model") check_model_parts(child, session);
  }
}

// A saved world may have bodies that were thrown far away.
void clamp_pose(Element& pose, Session& session) {
  constexpr double kMax = limits::kPosition.most;
  if (!session.dialect->corrects_values()) return;
  const Numbers found = numbers_in(pose.text);
  if (!found.bad.empty() || found.values.size() != 6) return;
  std::string text;
  bool far = false;
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    const double value = found.values[i];
    const bool beyond = i < 3 && std::isfinite(value) && std::abs(value) > kMax;
    far = far || beyond;
    text += number_text(beyond ? std::copysign(kMax, value) : value) + " ";
  }
  if (!far) return;
  session.warn(pose.source, "<pose> is beyond " + number_text(kMax) +
                                " m, the farthest position; it is taken as that");
  pose.text = text;
}

}  // namespace

void check_poses(Element& element, Session& session) {
  for (Element& child : element.children) {
    if (child.name == "plugin" || child.name == "state" || child.name == "gui") continue;
    if (child.name == "pose") {
      clamp_pose(child, session);
      pose_of(child);
    }
    check_poses(child, session);
  }
}

void check_settings(Element& world, Session& session) {
  check_children_names(world, session);
  for (const Element& child : world.children) {
    if (child.name == "light") check_typed_light(child, session);
    if (child.name == "physics") need_type(child, "type=\"ode\"", session);
    if (child.name == "plugin") check_plugin(child);
  }
  check_poses(world, session);
}

void check_model(Element& model, Session& session) {
  check_name(name_of(model), "<model>", model.source);
  check_poses(model, session);
  check_model_parts(model, session);
}

void check_part(Element& element, Session& session) {
  if (element.name == "sensor") check_sensor(element);
  if (element.name == "light") check_light(element);
  for (const Element& part : element.children) {
    if (part.name == "plugin") check_plugin(part);
  }
  check_poses(element, session);
}

}  // namespace angen::load
