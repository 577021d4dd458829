#include "sdf/load.h"

#include <filesystem>

#include "core/alike.h"
#include "core/limits.h"
#include "core/lists.h"
#include "core/names.h"
#include "document/dialect.h"
#include "document/search.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/check.h"
#include "sdf/describe.h"
#include "sdf/entry.h"
#include "sdf/upgrade.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

constexpr const char* kText = "(text)";  // named instead of a file
constexpr int kLoneVersion = 106;        // version of an element without <sdf> around it

bool is_text(const std::string& what) {
  constexpr const char* kBlanks = " \t\r\n\f\v\xEF\xBB\xBF";  // and a byte order mark
  const std::size_t first = what.find_first_not_of(kBlanks);
  return first != std::string::npos && what[first] == '<';
}

bool is_model(const Element& element) {
  return element.name == "model" || element.name == "include" || element.name == "actor";
}

// The one model in an <sdf>; null if it has other elements.
const Element* lone_model(const Element& sdf) {
  const Element* found = nullptr;
  for (const Element& child : sdf.children) {
    if (!is_model(child)) return nullptr;
    if (found != nullptr) throw Error(child.source, "a second " + tag_of(child) + "; give one");
    found = &child;
  }
  return found;
}

// The element of a text that may say its dialect.
const Element& marked_in(const Element& root) {
  const Element* child = root.name == "sdf" ? lone_model(root) : nullptr;
  return child == nullptr ? root : *child;
}

Element model_from_text(Element root, Session& session) {
  if (root.name == "sdf" || root.name == "robot") {
    const Element sdf = read_document(std::move(root), session);
    const Element* child = lone_model(sdf);
    if (child == nullptr) {
      throw Error(sdf.source, "expected <sdf> with one <model>, <include> or <actor>");
    }
    return *child;
  }
  if (!is_model(root)) {
    throw Error(root.source, "<" + root.name +
                                 "> is not a model; give <sdf>, <model>, <include>, "
                                 "<actor> or <robot>");
  }
  upgrade(root, kLoneVersion, session);
  make_uris_absolute(root, session);
  return root;
}

Element model_from_file(const std::string& what) {
  Element include{"include"};
  std::string uri = what;
  if (what.find("://") == std::string::npos) {
    std::error_code failed;
    if (what.empty() || !fs::exists(what, failed)) {
      throw Error("no file '" + what + "'; give a path, model://NAME, or the SDF itself");
    }
    uri = "file://" + fs::absolute(what).lexically_normal().string();
  }
  set_child(include, "uri", uri);
  return include;
}

const Dialect& dialect_of(const Element& element, const SearchPaths& paths, bool gazebo) {
  if (paths.default_dialect != DefaultDialect::kAuto) {
    gazebo = paths.default_dialect == DefaultDialect::kGazebo;
  }
  if (const std::optional<bool> strict = marked_strict(element)) gazebo = !*strict;
  return gazebo ? gazebo_dialect(element) : own_dialect();
}

void give_name(Element& element, const std::string& name) {
  if (name.empty()) return;
  if (element.name == "include") {
    set_child(element, "name", name);
  } else {
    set_attribute(element, "name", name);
  }
}

// Elements that are given without a model or world around them.

// The element of that name that a text is, or has in an <sdf>; null if the text is something else.
const Element* lone_in(const Element& root, const std::string& name) {
  if (root.name == name) return &root;
  const bool holds = root.name == "sdf" && root.children.size() == 1;
  return holds && root.children[0].name == name ? &root.children[0] : nullptr;
}

bool is_lone(const std::string& what, const std::string& name) {
  if (what.size() > kMaxTextBytes || what.find("<" + name) == std::string::npos) return false;
  try {
    return lone_in(parse_xml(what, kText), name) != nullptr;
  } catch (const Error&) {
    return false;  // reading it as a model reports the error
  }
}

// `given` replaces the name of the element unless it is empty.
Element read_lone(const std::string& what, const std::string& name, const std::string& given,
                  Session& session) {
  check_text_size(what);
  const Element root = parse_xml(what, kText);
  const Element* found = lone_in(root, name);
  if (found == nullptr) {
    throw Error(root.source, "expected <" + name + ">; this is <" + root.name + ">");
  }
  Element element = *found;
  upgrade(element, kLoneVersion, session);
  auto& attributes = element.attributes;
  erase_if(attributes, [](const auto& a) { return a.first == "version"; });
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
  const Element link{"link", "", {{"name", "link"}}, {sensor}, sensor.source};
  return {"model", "", {{"name", "model"}}, {link}, sensor.source};
}

}  // namespace

desc::Model model(const std::string& what, const std::string& name, const Pose& pose,
                  const SearchPaths& paths, bool gazebo) {
  if (!name.empty()) check_name(name, "the model", {});
  if (const std::string problem = pose_problem(pose); !problem.empty()) throw Error(problem);
  if (is_text(what)) check_text_size(what);
  Element element = is_text(what) ? parse_xml(what, kText) : model_from_file(what);
  std::optional<Session> read_by(Session{paths, &dialect_of(marked_in(element), paths, gazebo)});
  if (is_text(what)) element = model_from_text(std::move(element), *read_by);
  const Dialect& dialect = dialect_of(element, paths, gazebo);
  read_by->dialect = &dialect;
  if (&dialect != &own_dialect()) set_attribute(element, kStrict, "false");
  give_name(element, name);
  set_child(element, "pose", pose_text(pose));
  std::vector<Entry> entries = {expand_entry(element, *read_by)};
  // A URDF says its dialect when it is converted: that of a file is known only now.
  if (&dialect == &own_dialect() && marked_strict(entries.front().expanded) == false) {
    set_attribute(element, kStrict, "false");
    read_by.emplace(Session{paths, &gazebo_dialect(element)});
    entries = {expand_entry(element, *read_by)};
  }
  Session& session = *read_by;
  Entry& entry = entries.front();
  check_name(name_of(entry.expanded), "<" + entry.expanded.name + ">", element.source);
  if (element.name == "include" && name.empty()) {
    give_name(entry.original, name_of(entry.expanded));
  }
  std::vector<desc::Model> models = describe_entries(entries, session);
  if (models.empty()) throw Error(session.set_aside.back());
  desc::Model model = std::move(models.front());
  if (entries.front().expanded.name == "model") model.pose = pose * model.placed.inverse();
  model.warnings = merge_alike(session.warnings);
  model.ignored = session.ignored;
  return model;
}

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
    const Element root = parse_xml(what, kText);
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
