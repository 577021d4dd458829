#include "sdf/load.h"

#include <filesystem>

#include "core/alike.h"
#include "core/limits.h"
#include "core/names.h"
#include "document/search.h"
#include "document/tolerance.h"
#include "document/values.h"
#include "document/xml.h"
#include "import/upgrade.h"
#include "sdf/check.h"
#include "sdf/describe.h"
#include "sdf/entry.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

constexpr const char* kText = "(text)";  // named in place of a file
constexpr int kLoneVersion = 106;        // of an element without <sdf> around it

bool is_text(const std::string& what) {
  const std::size_t first = what.find_first_not_of(" \t\r\n\f\v");
  return first != std::string::npos && what[first] == '<';
}

bool is_model(const Element& element) {
  return element.name == "model" || element.name == "include" || element.name == "actor";
}

// The one element in an <sdf> that `accepts` is true for.
template <class F>
const Element* lone_child(const Element& sdf, F accepts) {
  const Element* found = nullptr;
  for (const Element& child : sdf.children) {
    if (!accepts(child)) return nullptr;
    if (found != nullptr) throw Error(child.source, "a second " + tag_of(child) + "; give one");
    found = &child;
  }
  return found;
}

Element model_from_text(const std::string& text, Session& session) {
  check_text_size(text);
  Element root = parse_xml(text, kText);
  if (root.name == "sdf" || root.name == "robot") {
    const Element sdf = read_document(text, kText, session);
    const Element* child = lone_child(sdf, is_model);
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
  replace_typographic_characters(root, session);
  upgrade(root, kLoneVersion, session);
  make_uris_absolute(root, session);
  return root;
}

Element model_from_file(const std::string& what) {
  Element include;
  include.name = "include";
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

bool is_tolerant(const Element& element, const SearchPaths& paths, bool by_default) {
  if (const std::optional<bool> strict = marked_strict(element)) return !*strict;
  if (paths.strictness == Strictness::kAuto) return by_default;
  return paths.strictness == Strictness::kTolerant;
}

void give_name(Element& element, const std::string& name) {
  if (name.empty()) return;
  if (element.name == "include") {
    set_child(element, "name", name);
  } else {
    set_attribute(element, "name", name);
  }
}

}  // namespace

desc::Model model(const std::string& what, const std::string& name, const Pose& pose,
                  const SearchPaths& paths, bool tolerant) {
  if (!name.empty()) check_name(name, "the model", {});
  if (const std::string problem = pose_problem(pose); !problem.empty()) throw Error(problem);
  Session session{paths};
  session.tolerant = paths.strictness != Strictness::kStrict;  // until the document is read
  Element element = is_text(what) ? model_from_text(what, session) : model_from_file(what);
  session.decide(is_tolerant(element, paths, tolerant));
  if (session.tolerant) set_attribute(element, kStrict, "false");
  give_name(element, name);
  set_child(element, "pose", pose_text(pose));
  std::vector<Entry> entries = {expand_entry(element, session)};
  Entry& entry = entries.front();
  check_name(name_of(entry.expanded), "<" + entry.expanded.name + ">", element.source);
  if (element.name == "include" && name.empty()) {
    give_name(entry.original, name_of(entry.expanded));
  }
  desc::Model model = std::move(describe_entries(entries, session).front());
  if (entry.expanded.name == "model") model.pose = pose;
  model.warnings = merge_alike(session.warnings);
  model.ignored = session.ignored;
  return model;
}

bool is_sensor(const std::string& what) {
  if (!is_text(what) || what.size() > kMaxTextBytes) return false;
  try {
    const Element root = parse_xml(what, kText);
    const auto accepts = [](const Element& e) { return e.name == "sensor"; };
    return accepts(root) || (root.name == "sdf" && lone_child(root, accepts) != nullptr);
  } catch (const Error&) {
    return false;  // reading it as a model reports the error
  }
}

desc::Sensor sensor(const std::string& what, const std::string& name, const Pose& pose) {
  if (!name.empty()) check_name(name, "the sensor", {});
  if (const std::string problem = pose_problem(pose); !problem.empty()) throw Error(problem);
  check_text_size(what);
  Element root = parse_xml(what, kText);
  if (root.name == "sdf") {
    const Element* child = lone_child(root, [](const Element& e) { return e.name == "sensor"; });
    if (child == nullptr) throw Error(root.source, "expected <sensor>; <sdf> has none");
    root = Element(*child);
  }
  if (root.name != "sensor") {
    throw Error(root.source, "expected <sensor>; this is <" + root.name + ">");
  }
  const SearchPaths nowhere;
  Session session{nowhere};
  replace_typographic_characters(root, session);
  upgrade(root, kLoneVersion, session);
  root.attributes.erase(std::remove_if(root.attributes.begin(), root.attributes.end(),
                                       [](const auto& a) { return a.first == "version"; }),
                        root.attributes.end());
  give_name(root, name);
  check_name(name_of(root), "<sensor>", root.source);
  check_part(root, session);
  set_child(root, "pose", pose_text(pose));
  // Errors that libsdformat would find in a saved world are found here.
  describe_models({holder_of(root)}, session);
  return sensor_of(root, pose, session);
}

}  // namespace angen::load
