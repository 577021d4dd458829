#include <functional>
#include <map>
#include <set>
#include <utility>

#include "document/xml.h"
#include "import/gazebo.h"
#include "sdf/upgrade.h"

namespace angen::load {

namespace {

std::string with_underscores(std::string name, const std::string& separator) {
  for (std::size_t at; (at = name.find(separator)) != std::string::npos;) {
    name.replace(at, separator.size(), "_");
  }
  return name;
}

// "__default__" as "default"; SDF has frames of such names.
std::string without_reserved(const std::string& name) {
  const bool is_reserved = name.size() > 4 && name.compare(0, 2, "__") == 0 &&
                           name.compare(name.size() - 2, 2, "__") == 0;
  return is_reserved && name != "__model__" ? name.substr(2, name.size() - 4) : name;
}

using Rename = std::function<std::string(const std::string&)>;

// Until 1.7 a name could hold "::", as those of models that Gazebo once saved flat. A '/' Gazebo
// takes in every version. Topics are often called as their model, so texts like its name stay.
void change_names(Element& element, const Rename& rename, const std::string& reason,
                  std::map<std::string, std::string>& found, Session& session) {
  static const std::set<std::string> named = {"link",   "joint", "collision", "visual",
                                              "sensor", "light", "frame",     "model"};
  const std::string name = named.count(element.name) != 0 ? name_of(element) : "";
  const std::string right = rename(name);
  if (right != name) {
    set_attribute(element, "name", right);
    session.warn_or_throw(
        Error(element.source, tag_of(element) + ": " + reason + "; it is '" + right + "' here"));
    if (element.name != "model") found[name] = name_of(element);
  }
  for (Element& child : element.children) {
    if (child.name != "plugin") change_names(child, rename, reason, found, session);
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

void rename_parts(Element& sdf, const Rename& rename, const std::string& reason, Session& session) {
  std::map<std::string, std::string> found;
  change_names(sdf, rename, reason, found, session);
  if (!found.empty()) rename_references(sdf, found);
}

void rename_separated(Element& sdf, const std::string& separator, Session& session) {
  rename_parts(
      sdf, [&](const std::string& name) { return with_underscores(name, separator); },
      "names hold no '" + separator + "'", session);
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

}  // namespace

void Gazebo::correct_names(Element& sdf, int version, Session& session) const {
  if (version < 108) rename_separated(sdf, "::", session);
  rename_separated(sdf, "/", session);
  rename_parts(sdf, without_reserved, "names between two '__' are reserved", session);
  if (version < 107) rename_duplicates(sdf, session);
}

}  // namespace angen::load
