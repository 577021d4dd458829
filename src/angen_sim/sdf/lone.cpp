#include <algorithm>

#include "core/limits.h"
#include "core/names.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/check.h"
#include "sdf/describe.h"
#include "sdf/light.h"
#include "sdf/load.h"
#include "sdf/upgrade.h"

/// Elements that are given without a model or world around them.
namespace angen::load {

namespace {

constexpr const char* kLoneText = "(text)";  // named instead of a file
constexpr int kSinceVersion = 106;           // version of an element without <sdf> around it

// The element of that name that a text is, or has in an <sdf>; null if the text is something else.
const Element* lone_in(const Element& root, const std::string& name) {
  if (root.name == name) return &root;
  const bool holds = root.name == "sdf" && root.children.size() == 1;
  return holds && root.children[0].name == name ? &root.children[0] : nullptr;
}

bool is_lone(const std::string& what, const std::string& name) {
  if (what.size() > kMaxTextBytes || what.find("<" + name) == std::string::npos) return false;
  try {
    return lone_in(parse_xml(what, kLoneText), name) != nullptr;
  } catch (const Error&) {
    return false;  // reading it as a model reports the error
  }
}

// `given` replaces the name of the element unless it is empty.
Element read_lone(const std::string& what, const std::string& name, const std::string& given,
                  Session& session) {
  check_text_size(what);
  const Element root = parse_xml(what, kLoneText);
  const Element* found = lone_in(root, name);
  if (found == nullptr) {
    throw Error(root.source, "expected <" + name + ">; this is <" + root.name + ">");
  }
  Element element = *found;
  upgrade(element, kSinceVersion, session);
  auto& attributes = element.attributes;
  attributes.erase(std::remove_if(attributes.begin(), attributes.end(),
                                  [](const auto& a) { return a.first == "version"; }),
                   attributes.end());
  if (!given.empty()) set_attribute(element, "name", given);
  return element;
}

// read_lone, and checks it.
Element checked_lone(const std::string& what, const std::string& name, const std::string& given,
                     const Pose& pose, Session& session) {
  if (!given.empty()) check_name(given, "the " + name, {});
  if (const std::string problem = pose_problem(pose); !problem.empty()) throw Error(problem);
  Element element = read_lone(what, name, given, session);
  check_name(name_of(element), "<" + name + ">", element.source);
  check_part(element, session);
  return element;
}

// A model whose one link holds the sensor.
Element holder_of(const Element& sensor) {
  Element link;
  link.name = "link";
  link.source = sensor.source;
  link.attributes = {{"name", "link"}};
  link.children = {sensor};
  Element model = link;
  model.name = "model";
  model.attributes = {{"name", "model"}};
  model.children = {link};
  return model;
}

}  // namespace

bool is_sensor(const std::string& what) { return is_lone(what, "sensor"); }

desc::Sensor sensor(const std::string& what, const std::string& name, const Pose& pose) {
  const SearchPaths nowhere;
  Session session{nowhere};
  Element element = checked_lone(what, "sensor", name, pose, session);
  set_child(element, "pose", pose_text(pose));
  describe_model(holder_of(element), session);  // errors that a saved world would have
  return sensor_of(element, pose, session);
}

bool is_light(const std::string& what) { return is_lone(what, "light"); }

std::string included_light(const std::string& what, const SearchPaths& paths) {
  if (what.find("<include") == std::string::npos) return "";
  try {
    const Element root = parse_xml(what, kLoneText);
    const Element* holder = &root;
    if (root.name == "sdf" && root.children.size() == 1) {
      holder = root.children[0].name == "world" ? &root.children[0] : &root;
    }
    if (holder->children.size() != 1 || holder->children[0].name != "include") return "";
    Session session{paths, &gazebo_dialect(root)};
    const Element included = expand_include(holder->children[0], session);
    return included.name == "light" ? print_xml(included) : "";
  } catch (const Error&) {
    return "";  // reading it as a model reports the error
  }
}

desc::Light light(const std::string& what, const std::string& name, const Pose& pose) {
  const SearchPaths nowhere;
  Session session{nowhere};
  const Element element = checked_lone(what, "light", name, pose, session);
  desc::Light light = light_of(element, pose * child_pose(element), session);
  if (!light.level) light.level = 100.0;
  return light;
}

Element light_element(const std::string& what, const std::string& name) {
  const SearchPaths nowhere;
  Session session{nowhere};
  return read_lone(what, "light", name, session);
}

}  // namespace angen::load
