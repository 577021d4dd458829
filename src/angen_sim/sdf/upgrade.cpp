#include "sdf/upgrade.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/lists.h"
#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"

namespace angen::load {

namespace {

const std::set<std::string> kColors = {"ambient", "background", "diffuse", "emissive", "specular"};
constexpr const char* kUnlimited = "1e9";  // friction; nothing slides

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

// A position alone, as older files have it; others are wrong.
void fill_pose(Element& pose, Session& session) {
  if (pose.attribute("rotation_format") != nullptr) return;
  const Numbers found = numbers_in(pose.text);
  const std::size_t count = found.values.size();
  if (!found.bad.empty() || count == 0 || count >= 6) return;
  if (count == 3) {
    session.warn(pose.source,
                 "<pose> contains 3 numbers and is read as a position; write 6, x y z and "
                 "roll pitch yaw");
  } else {
    session.warn_or_throw(Error(pose.source, "<pose> contains " + std::to_string(count) +
                                                 " numbers; give 6 numbers; those that are "
                                                 "missing are taken as 0"));
  }
  for (std::size_t i = count; i < 6; ++i) pose.text += " 0";
}

// Colors of 0 to 255.
void scale_color(Element& color, Session& session) {
  constexpr double kNoOfOne = 10.0;  // a light may be brighter than 1
  const Numbers found = numbers_in(color.text);
  if (!found.bad.empty() || found.values.size() < 3 || found.values.size() > 4) return;
  const double most = *std::max_element(found.values.begin(), found.values.begin() + 3);
  if (!(most > kNoOfOne && most <= 255.0)) return;
  session.warn(color.source, "<" + color.name + "> has a part of " + number_text(most) +
                                 "; those of a color are 0 to 1, so these are divided by 255");
  color.text.clear();
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    const bool is_share = i == 3 && found.values[i] <= 1.0;
    color.text += number_text(is_share ? found.values[i] : found.values[i] / 255.0) + " ";
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
  if (joint.attribute_text("type") == "revolute2") set_attribute(joint, "type", "universal");
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
  if (kColors.count(element.name) != 0) scale_color(element, session);
  if (element.name == "mu" || element.name == "mu2") read_unlimited(element);
  if (element.name == "joint") read_joint_type(element);
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
    erase_if(all, [](const auto& a) { return a.first == "relative_to" && a.second.empty(); });
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
  session.dialect->correct_names(sdf, version, session);
  set_attribute(sdf, "version", "1.9");
}

std::string names_shared_by(const Element& child) {
  static const std::set<std::string> shared = {"link", "joint", "frame", "model"};
  static const std::set<std::string> own = {"collision", "visual", "sensor", "light", "actor"};
  if (shared.count(child.name) != 0) return "frame";
  return own.count(child.name) != 0 ? child.name : "";
}

}  // namespace angen::load
