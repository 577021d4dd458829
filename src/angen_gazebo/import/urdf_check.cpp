#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "import/gazebo.h"

namespace angen::load {

namespace {

constexpr std::size_t kMaxLinks = 1000;
constexpr std::size_t kMaxChain = 200;  // joints from a link to the root
constexpr std::size_t kMaxLumped = 100'000;

void need_link(const Element& joint, const char* end, const std::set<std::string>& links) {
  const Element* element = joint.child(end);
  const std::string* link = element == nullptr ? nullptr : element->attribute("link");
  if (link == nullptr) {
    throw Error(joint.source, tag_of(joint) + " has no <" + end + " link=\"…\"/>; name a link");
  }
  if (links.count(*link) == 0) {
    throw Error(element->source, tag_of(joint) + " names an unknown link '" + printable(*link) +
                                     "'; known are " + join_names({links.begin(), links.end()}));
  }
}

void check_numbers(const Element& element) {
  static const std::set<std::string> texts = {"name",        "link",      "type",
                                              "filename",    "reference", "joint",
                                              "xmlns:xacro", "version",   "value_type"};
  static const std::map<std::string, std::size_t> rows = {
      {"xyz", 3}, {"rpy", 3}, {"size", 3}, {"scale", 3}, {"rgba", 4}};
  static const std::set<std::string> limits = {"lower", "upper", "effort", "velocity"};
  static const std::set<std::string> read = {
      "link",        "inertial", "mass",    "inertia", "visual", "collision", "geometry",
      "box",         "cylinder", "sphere",  "mesh",    "origin", "material",  "color",
      "joint",       "parent",   "child",   "axis",    "limit",  "dynamics",  "safety_controller",
      "calibration", "mimic",    "contact", "texture"};
  if (read.count(element.name) == 0) return;  // other elements mean nothing, as <joint_properties>
  for (const auto& [key, value] : element.attributes) {
    if (texts.count(key) != 0) continue;
    const Numbers found = numbers_in(value);
    const std::string where = "<" + element.name + " " + key + "> contains '";
    if (!found.bad.empty()) {
      throw Error(element.source, where + printable(found.bad) + "', which is not a number");
    }
    const auto row = rows.find(key);
    const std::size_t count = row == rows.end() ? 1 : row->second;
    const bool any = limits.count(key) != 0;
    const bool good = std::all_of(found.values.begin(), found.values.end(), [&](double v) {
      return any ? !std::isnan(v) : std::isfinite(v);
    });
    if (found.values.size() != count || !good) {
      throw Error(element.source, where + printable(value) + "'; give " + std::to_string(count) +
                                      " finite number" + (count == 1 ? "" : "s"));
    }
  }
  for (const Element& child : element.children) check_numbers(child);
}

// libsdformat recurses along chains, and takes a time that grows with their square.
void check_chains(const Element& robot, std::size_t links) {
  if (links > kMaxLinks) {
    throw Error(robot.source, "more than " + std::to_string(kMaxLinks) +
                                  " links in one robot; split it into several");
  }
  std::map<std::string, std::string> parents;
  for (const Element& child : robot.children) {
    if (child.name != "joint") continue;
    parents[*child.child("child")->attribute("link")] = *child.child("parent")->attribute("link");
  }
  for (const auto& [link, parent] : parents) {
    std::size_t length = 0;
    for (auto at = parents.find(link); at != parents.end(); at = parents.find(at->second)) {
      if (++length <= kMaxChain) continue;
      throw Error(robot.source, "a chain of more than " + std::to_string(kMaxChain) +
                                    " joints, or a loop of them, above the link '" +
                                    printable(link) + "'; make it shorter");
    }
  }
}

// libsdformat looks at each part of a <gazebo> for each fixed joint.
void check_lumped(const Element& robot) {
  std::size_t joints = 0, parts = 0;
  for (const Element& child : robot.children) {
    if (child.name == "joint" && child.attribute_text("type") == "fixed") ++joints;
    if (child.name == "gazebo") parts += child.children.size();
  }
  if (joints * parts <= kMaxLumped) return;
  throw Error(robot.source, std::to_string(joints) + " fixed joints with " + std::to_string(parts) +
                                " elements in <gazebo>; their product may be at most " +
                                std::to_string(kMaxLumped) + ": split the robot into several");
}

}  // namespace

void check_robot(const Element& robot) {
  std::set<std::string> links;
  std::set<std::string> joints;
  for (const Element& child : robot.children) {
    if (child.name != "link" && child.name != "joint") continue;
    auto& names = child.name == "link" ? links : joints;
    if (name_of(child).empty()) throw Error(child.source, "<" + child.name + "> has no name");
    if (!names.insert(name_of(child)).second) {
      throw Error(child.source, "the name '" + name_of(child) + "' is given twice; give this <" +
                                    child.name + "> another");
    }
    check_numbers(child);
  }
  if (links.empty()) throw Error(robot.source, "<robot> has no <link>; give it one");
  for (const Element& child : robot.children) {
    if (child.name != "joint") continue;
    need_link(child, "parent", links);
    need_link(child, "child", links);
  }
  check_chains(robot, links.size());
  check_model_size(count_elements(robot), robot.source);  // its conversion would take long
  check_lumped(robot);
}

}  // namespace angen::load
