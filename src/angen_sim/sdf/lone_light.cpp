#include "core/limits.h"
#include "core/names.h"
#include "document/session.h"
#include "document/values.h"
#include "document/xml.h"
#include "import/upgrade.h"
#include "sdf/check.h"
#include "sdf/expand.h"
#include "sdf/light.h"
#include "sdf/load.h"

namespace angen::load {

namespace {

constexpr const char* kLightText = "(text)";
constexpr int kLightVersion = 106;  // of an element without <sdf> around it

// Null where the text is something else.
const Element* light_in(const Element& root) {
  if (root.name == "light") return &root;
  const bool lone =
      root.name == "sdf" && root.children.size() == 1 && root.children[0].name == "light";
  return lone ? &root.children[0] : nullptr;
}

Element read_light(const std::string& what, const std::string& name, Session& session) {
  const Element root = parse_xml(what, kLightText);
  const Element* found = light_in(root);
  if (found == nullptr) throw Error(root.source, "expected <light>; this is <" + root.name + ">");
  Element element = *found;
  replace_typographic_characters(element, session);
  upgrade(element, kLightVersion, session);
  if (!name.empty()) set_attribute(element, "name", name);
  return element;
}

}  // namespace

bool is_light(const std::string& what) {
  if (what.find("<light") == std::string::npos) return false;
  try {
    return light_in(parse_xml(what, kLightText)) != nullptr;
  } catch (const Error&) {
    return false;  // reading it as a model reports the error
  }
}

std::string included_light(const std::string& what, const SearchPaths& paths) {
  if (what.find("<include") == std::string::npos) return "";
  try {
    const Element root = parse_xml(what, kLightText);
    const Element* holder = &root;
    if (root.name == "sdf" && root.children.size() == 1) {
      holder = root.children[0].name == "world" ? &root.children[0] : &root;
    }
    if (holder->children.size() != 1 || holder->children[0].name != "include") return "";
    Session session{paths};
    session.tolerant = true;
    const Element included = expand_include(holder->children[0], session);
    return included.name == "light" ? print_xml(included) : "";
  } catch (const Error&) {
    return "";  // reading it as a model reports the error
  }
}

desc::Light light(const std::string& what, const std::string& name, const Pose& pose) {
  if (!name.empty()) check_name(name, "the light", {});
  if (const std::string problem = pose_problem(pose); !problem.empty()) throw Error(problem);
  const SearchPaths nowhere;
  Session session{nowhere};
  Element element = read_light(what, name, session);
  check_name(name_of(element), "<light>", element.source);
  check_part(element, session);
  desc::Light light = light_of(element, pose * child_pose(element), session);
  if (!light.level) light.level = 100.0;
  return light;
}

Element light_element(const std::string& what, const std::string& name) {
  const SearchPaths nowhere;
  Session session{nowhere};
  return read_light(what, name, session);
}

}  // namespace angen::load
