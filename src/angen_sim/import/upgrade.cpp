#include "import/upgrade.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "document/values.h"
#include "document/xml.h"

namespace angen::load {

namespace {

constexpr const char* kUnlimited = "1e9";  // of friction: nothing slides

bool truthy(const std::string& text) {
  return text == "true" || text == "1" || text == "True" || text == "TRUE";
}

// Until 1.4 an axis was given in the model's frame, in 1.5 and 1.6 where it said so.
void upgrade_axis(Element& axis, int version) {
  const bool in_model = version < 105 || truthy(axis.child_text("use_parent_model_frame"));
  remove_children(axis, "use_parent_model_frame");
  Element* xyz = find_child(axis, "xyz");
  if (xyz != nullptr && in_model) set_attribute(*xyz, "expressed_in", "__model__");
}

// A position alone, as older files have it.
void fill_pose(Element& pose, Session& session) {
  if (pose.attribute("rotation_format") != nullptr) return;
  const Numbers found = numbers_in(pose.text);
  if (!found.bad.empty() || found.values.size() != 3) return;
  session.warn(pose.source,
               "<pose> contains 3 numbers and is read as a position; write 6, x y z and "
               "roll pitch yaw");
  pose.text += " 0 0 0";
}

std::string with_underscores(std::string name, const std::string& separator) {
  for (std::size_t at; (at = name.find(separator)) != std::string::npos;) {
    name.replace(at, separator.size(), "_");
  }
  return name;
}

// Until 1.7 a name could hold "::", as those of models that Gazebo once saved flat. A '/' Gazebo
// takes in every version. Topics are often called as their model, so texts like its name stay.
void split_names(Element& element, const std::string& separator,
                 std::map<std::string, std::string>& found, Session& session) {
  static const std::set<std::string> named = {"link",   "joint", "collision", "visual",
                                              "sensor", "light", "frame",     "model"};
  const std::string name = named.count(element.name) != 0 ? name_of(element) : "";
  if (name.find(separator) != std::string::npos) {
    set_attribute(element, "name", with_underscores(name, separator));
    session.warn_or_throw(Error(element.source, tag_of(element) + ": names hold no '" + separator +
                                                    "'; it is '" + name_of(element) + "' here"));
    if (element.name != "model") found[name] = name_of(element);
  }
  for (Element& child : element.children) {
    if (child.name != "plugin") split_names(child, separator, found, session);
  }
}

// Renames references to a renamed part, also in parameters of plug-ins.
void rename_references(Element& element, const std::map<std::string, std::string>& found) {
  const auto replace = [&](std::string& text) {
    const auto other = found.find(text);
    if (other != found.end()) text = other->second;
  };
  replace(element.text);
  for (auto& [key, value] : element.attributes) {
    if (key == "relative_to" || key == "expressed_in" || key == "attached_to") replace(value);
  }
  for (Element& child : element.children) rename_references(child, found);
}

void rename_separated(Element& sdf, const std::string& separator, Session& session) {
  std::map<std::string, std::string> found;
  split_names(sdf, separator, found, session);
  if (!found.empty()) rename_references(sdf, found);
}

using Name = std::pair<std::string, std::string>;  // the parts that share it, and the name

std::string unused_name(const Element& child, std::set<Name>& used, std::map<Name, int>& tried) {
  const std::string space = names_shared_by(child);
  const std::string stem = name_of(child) + (child.name == "joint" ? "_joint" : "");
  std::string name = stem;
  while (!used.insert({space, name}).second) {
    name = stem + "_" + std::to_string(++tried[{space, stem}]);
  }
  return name;
}

void rename_twins(Element& parent, Session& session) {
  std::set<Name> used, seen;
  std::map<Name, int> tried;
  for (const Element& child : parent.children) {
    used.insert({names_shared_by(child), name_of(child)});
  }
  for (Element& child : parent.children) {
    const Name name{names_shared_by(child), name_of(child)};
    const bool is_world = child.name == "joint" && name.second == "world";
    if (name.first.empty() || name.second.empty() || (seen.insert(name).second && !is_world)) {
      continue;
    }
    const std::string given = tag_of(child);
    set_attribute(child, "name", unused_name(child, used, tried));
    const std::string reason = is_world ? ": the name is that of the world"
                                        : ": the name is given twice in " + tag_of(parent);
    session.warn_or_throw(
        Error(child.source, given + reason + "; it is '" + name_of(child) + "' here"));
  }
}

// Until 1.7 parts of a model could have one name; references to it mean the first.
void rename_duplicates(Element& element, Session& session) {
  if (element.name == "model" || element.name == "link") rename_twins(element, session);
  for (Element& child : element.children) {
    if (child.name != "plugin") rename_duplicates(child, session);
  }
}

// Gazebo takes a negative or infinite value as no limit.
void read_unlimited(Element& friction) {
  const Numbers found = numbers_in(friction.text);
  const bool unlimited = found.bad.empty() && found.values.size() == 1 &&
                         (found.values[0] < 0.0 || std::isinf(found.values[0]));
  if (unlimited) friction.text = kUnlimited;
}

// Two axes that cross, as those of a car's front wheel: in ODE the same.
void read_joint_type(Element& joint) {
  const std::string* type = joint.attribute("type");
  if (type != nullptr && *type == "revolute2") set_attribute(joint, "type", "universal");
}

// Gazebo reads the first shape; of polylines all count.
void keep_one_shape(Element& geometry, Session& session) {
  auto& all = geometry.children;
  if (all.empty()) return;
  const bool prism = all[0].name == "polyline";
  const auto others = std::stable_partition(all.begin() + 1, all.end(), [&](const Element& shape) {
    return prism && shape.name == "polyline";
  });
  if (others == all.end()) return;
  session.warn_or_throw(Error(others->source, "a second shape in one <geometry>; keep one: <" +
                                                  all[0].name + "> is taken, <" + others->name +
                                                  "> is left out"));
  all.erase(others, all.end());
}

// Attributes of SDF 1.0 that are the text of their element since.
const std::map<std::string, std::string>& texts_of_1_0() {
  static const std::map<std::string, std::string> table = {
      {"ambient", "rgba"},  {"background", "rgba"}, {"child", "link"},
      {"diffuse", "rgba"},  {"direction", "xyz"},   {"emissive", "rgba"},
      {"gravity", "xyz"},   {"grid", "enabled"},    {"origin", "pose"},
      {"parent", "link"},   {"shadows", "enabled"}, {"horizontal_fov", "angle"},
      {"specular", "rgba"},
  };
  return table;
}

// The child that an attribute of SDF 1.0 became, or "" for one that stayed: names and most types.
std::string child_for(const std::string& attribute, const std::string& element) {
  static const std::map<std::pair<std::string, std::string>, std::string> renamed = {
      {{"fog", "rgba"}, "color"},
      {{"fog", "type"}, "type"},
      {{"heightmap", "origin"}, "pos"},
      {{"solver", "type"}, "type"},
  };
  static const std::set<std::string> stayed = {"name", "type", "version", "world_name"};
  const auto found = renamed.find({element, attribute});
  if (found != renamed.end()) return found->second;
  const bool stays = stayed.count(attribute) != 0 || attribute.find(':') != std::string::npos;
  return stays ? "" : attribute;
}

// SDF 1.0 had values in attributes.
void upgrade_attributes(Element& element) {
  if (element.name == "plugin") return;
  for (Element& child : element.children) upgrade_attributes(child);
  const auto key = texts_of_1_0().find(element.name);
  const std::string* value = key == texts_of_1_0().end() ? nullptr : element.attribute(key->second);
  if (value != nullptr) {
    const std::string name = element.name == "origin" ? "pose" : element.name;
    element = Element{name, *value, {}, {}, element.source};  // also without a background's sky
    return;
  }
  std::vector<std::pair<std::string, std::string>> kept;
  std::vector<Element> children;
  for (auto& [name, text] : element.attributes) {
    const std::string child = child_for(name, element.name);
    if (child.empty()) {
      kept.push_back({name, text});
    } else {
      children.push_back({child, text, {}, {}, element.source});
    }
  }
  element.attributes = std::move(kept);
  element.children.insert(element.children.begin(), children.begin(), children.end());
}

// SDF 1.3 named the step and the rate otherwise.
void upgrade_physics(Element& physics) {
  const auto move = [&](const Element* from, const char* to) {
    if (from != nullptr && physics.child(to) == nullptr) {
      const std::string text = from->text;
      set_child(physics, to, text);
    }
  };
  move(physics.child("update_rate"), "real_time_update_rate");
  remove_children(physics, "update_rate");
  Element* ode = find_child(physics, "ode");
  Element* solver = ode == nullptr ? nullptr : find_child(*ode, "solver");
  if (solver == nullptr) return;
  const Element* step = solver->child("dt");
  const std::string text = step == nullptr ? "" : step->text;
  remove_children(*solver, "dt");
  if (!text.empty() && physics.child("max_step_size") == nullptr) {
    set_child(physics, "max_step_size", text);
  }
}

// SDF 1.3 named files of shapes otherwise, the collision of a contact sensor by an attribute, and a
// material by the text of <script>.
void name_old_parts(Element& element) {
  static const std::set<std::string> with_files = {"mesh", "heightmap", "image"};
  for (Element& child : element.children) {
    if (child.name == "filename" && with_files.count(element.name) != 0) child.name = "uri";
    if (element.name == "material" && child.name == "script" && !child.text.empty()) {
      const std::string name = std::move(child.text);
      child.text.clear();
      set_child(child, "name", name);
    }
    if (element.name != "contact" || child.name != "collision" || !child.text.empty()) continue;
    child.text = name_of(child);
    child.attributes.clear();
  }
}

void upgrade_element(Element& element, int version, Session& session) {
  if (element.name == "plugin") return;
  if (element.name == "pose") fill_pose(element, session);
  if (element.name == "mu" || element.name == "mu2") read_unlimited(element);
  if (element.name == "joint") read_joint_type(element);
  if (element.name == "geometry") keep_one_shape(element, session);
  if (element.name == "physics" && version < 104) upgrade_physics(element);
  if (version < 104) name_old_parts(element);
  if (element.name == "joint" && version < 107) {
    for (Element& child : element.children) {
      if (child.name == "axis" || child.name == "axis2") upgrade_axis(child, version);
    }
  }
  if (element.name == "pose") {
    for (auto& [key, value] : element.attributes) {
      if (key == "frame" && version < 107) key = "relative_to";
    }
    auto& all = element.attributes;
    all.erase(
        std::remove_if(all.begin(), all.end(),
                       [](const auto& a) { return a.first == "relative_to" && a.second.empty(); }),
        all.end());
  }
  if (element.name == "world" && version < 106) {
    if (Element* physics = find_child(element, "physics")) {
      const Element* gravity = physics->child("gravity");
      if (gravity != nullptr && element.child("gravity") == nullptr) {
        const Element moved = *gravity;
        remove_children(*physics, "gravity");
        remove_children(*physics, "magnetic_field");
        element.children.push_back(moved);
      }
    }
  }
  for (Element& child : element.children) upgrade_element(child, version, session);
}

}  // namespace

void upgrade(Element& sdf, int version, Session& session) {
  if (version < 102) upgrade_attributes(sdf);
  upgrade_element(sdf, version, session);
  if (session.tolerant) {
    if (version < 108) rename_separated(sdf, "::", session);
    rename_separated(sdf, "/", session);
    if (version < 107) rename_duplicates(sdf, session);
  }
  set_attribute(sdf, "version", "1.9");
}

std::string names_shared_by(const Element& child) {
  static const std::set<std::string> shared = {"link", "joint", "frame", "model"};
  static const std::set<std::string> own = {"collision", "visual", "sensor", "light", "actor"};
  if (shared.count(child.name) != 0) return "frame";
  return own.count(child.name) != 0 ? child.name : "";
}

}  // namespace angen::load
