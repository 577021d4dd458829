#include "sdf/entry.h"

#include <algorithm>
#include <map>
#include <optional>

#include "core/lists.h"
#include "document/dialect.h"
#include "document/xml.h"
#include "sdf/check.h"
#include "sdf/describe.h"

namespace angen::load {

namespace {

bool holds_include(const Element& element) {
  if (element.name == "include") return true;
  for (const Element& child : element.children) {
    if (child.name == "model" || child.name == "include") {
      if (holds_include(child)) return true;
    }
  }
  return false;
}

// A model's description depends on all but its name, pose and plug-ins, and on the lines of its
// elements.
std::string key_of(const Element& model) {
  Element bare = model;
  auto& attributes = bare.attributes;
  erase_if(attributes, [](const auto& a) { return a.first == "name"; });
  remove_children(bare, "pose");
  remove_children(bare, "plugin");
  std::vector<Source> lines;
  std::string key = print_xml(bare, 0, &lines);
  for (const Source& line : lines) key += line.file + ":" + std::to_string(line.line) + ";";
  return key;
}

// Whether it has a collision with a shape.
bool is_solid(const Element& element) {
  return std::any_of(element.children.begin(), element.children.end(), [](const Element& part) {
    if (part.name == "link" || part.name == "model") return is_solid(part);
    const Element* geometry = part.name == "collision" ? part.child("geometry") : nullptr;
    return geometry != nullptr && geometry->child("empty") == nullptr;
  });
}

// Nothing would stop the fall of a model whose shapes are all left out.
void hold_without_shape(const Entry& entry, desc::Model& model, Session& session) {
  if (session.set_aside.empty() || model.is_static || !entry.is_solid) return;
  for (const desc::Link& link : model.links) {
    for (const desc::Collision& collision : link.collisions) {
      if (collision.shape.type != Shape::Type::kEmpty) return;
    }
  }
  for (desc::Link& link : model.links) link.gravity = false;
  session.warn(entry.original.source, tag_of(entry.expanded) +
                                          " has no collision left, so that nothing would stop its "
                                          "fall; it has no gravity here");
}

// Adds what its dialect and its plug-ins leave out.
void complete(const Entry& entry, desc::Model& model) {
  if (std::any_of(model.plugins.begin(), model.plugins.end(),
                  [](const desc::Plugin& plugin) { return plugin.is_repeatable; })) {
    gazebo_dialect(entry.expanded).prepare_plugins(model);
  }
  if (marked_strict(entry.original) == false) gazebo_dialect(entry.original).complete(model);
}

// False where it is left out.
bool check_entry(Entry& entry, Session& session) {
  Element& element = entry.expanded;
  if (element.name != "model" && element.name != "actor") {
    throw Error(element.source,
                "<" + element.name + "> is not a model; give <model>, <include> or <actor>");
  }
  check_model_size(count_elements(element), entry.original.source);
  check_memory(element, session);
  if (element.name != "model") return true;
  return session.read_without_errors({&element}, [&] { check_model(element, session); });
}

using ReadModels = std::map<std::string, std::optional<desc::Model>>;

// All different models by their keys, without plug-ins; none for one that is left out.
ReadModels read_once(std::vector<Entry>& entries, Session& session) {
  ReadModels read;
  erase_if(entries, [&](Entry& entry) { return !check_entry(entry, session); });
  for (const Entry& entry : entries) {
    if (entry.expanded.name != "model") continue;
    const auto [at, fresh] = read.try_emplace(key_of(entry.expanded));
    if (!fresh) continue;
    Element model = entry.expanded;
    remove_children(model, "plugin");
    auto& made = at->second;
    session.read_without_errors({&model}, [&] { made = describe_model(model, session); });
  }
  return read;
}

}  // namespace

Entry expand_entry(const Element& element, Session& session) {
  Entry entry{element, element};
  if (element.name == "include") {
    if (is_merge(element)) {
      throw Error(element.source,
                  "an <include> with merge outside of a <model>; include without it");
    }
    entry.expanded = expand_include(element, session);
  }
  if (element.name == "model") expand_model(entry.expanded, session);
  entry.is_solid = is_solid(entry.expanded);
  return entry;
}

std::vector<desc::Model> describe_entries(std::vector<Entry>& entries, Session& session) {
  const ReadModels read = read_once(entries, session);
  std::vector<desc::Model> models;
  std::vector<Entry> kept;
  for (Entry& entry : entries) {
    Element& element = entry.expanded;
    std::optional<desc::Model> found;
    if (element.name == "actor") {
      session.read_without_errors({&element}, [&] { found = describe_actor(element, session); });
    } else {
      found = read.at(key_of(element));
    }
    if (!found) continue;
    desc::Model model = *std::move(found);
    for (const Element& child : element.children) {
      if (element.name == "model" && child.name == "plugin") {
        model.plugins.push_back(plugin_of(child));
      }
    }
    model.name = name_of(element);
    model.source = entry.original.source;
    complete(entry, model);
    hold_without_shape(entry, model, session);
    model.xml = print_xml(entry.original);
    if (holds_include(entry.original)) model.expanded_xml = print_xml(element);
    models.push_back(std::move(model));
    kept.push_back(std::move(entry));
  }
  entries = std::move(kept);
  return models;
}

}  // namespace angen::load
