#include "sdf/entry.h"

#include <map>

#include "document/tolerance.h"
#include "document/xml.h"
#include "import/gazebo_model.h"
#include "sdf/check.h"
#include "sdf/cost.h"
#include "sdf/describe.h"

namespace angen::load {

namespace {

constexpr std::size_t kBatchElements = 2'000;

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
  bare.attributes.clear();
  remove_children(bare, "pose");
  remove_children(bare, "plugin");
  std::vector<Source> lines;
  std::string key = print_xml(bare, 0, &lines);
  for (const Source& line : lines) key += line.file + ":" + std::to_string(line.line) + ";";
  return key;
}

void check_entry(Entry& entry, Session& session) {
  Element& element = entry.expanded;
  if (element.name != "model" && element.name != "actor") {
    throw Error(element.source,
                "<" + element.name + "> is not a model; give <model>, <include> or <actor>");
  }
  check_model_size(count_elements(element), entry.original.source);
  check_memory(element, session);
  if (element.name == "model") check_model(element, session);
}

// All different models by their keys. libsdformat takes tens of milliseconds a document and a
// megabyte a link, so they go to it in batches.
std::map<std::string, desc::Model> read_once(std::vector<Entry>& entries, Session& session) {
  std::map<std::string, desc::Model> read;
  std::vector<std::string> keys;
  std::vector<Element> batch;
  std::size_t size = 0;
  const auto flush = [&] {
    std::vector<desc::Model> models = describe_models(batch, session);
    for (std::size_t i = 0; i < models.size(); ++i) read[keys[i]] = std::move(models[i]);
    keys.clear();
    batch.clear();
    size = 0;
  };
  for (Entry& entry : entries) {
    check_entry(entry, session);
    if (entry.expanded.name != "model") continue;
    const std::string key = key_of(entry.expanded);
    if (!read.emplace(key, desc::Model{}).second) continue;
    keys.push_back(key);
    batch.push_back(entry.expanded);
    remove_children(batch.back(), "plugin");
    size += count_elements(batch.back());
    if (size > kBatchElements) flush();
  }
  flush();
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
  return entry;
}

std::vector<desc::Model> describe_entries(std::vector<Entry>& entries, Session& session) {
  const std::map<std::string, desc::Model> read = read_once(entries, session);
  std::vector<desc::Model> models;
  for (const Entry& entry : entries) {
    const Element& element = entry.expanded;
    desc::Model model =
        element.name == "actor" ? describe_actor(element, session) : read.at(key_of(element));
    for (const Element& child : element.children) {
      if (element.name == "model" && child.name == "plugin") {
        model.plugins.push_back(plugin_of(child));
      }
    }
    model.name = name_of(element);
    model.source = entry.original.source;
    model.tolerant = marked_strict(entry.original) == false;
    hold_measured_joints(model);
    if (model.tolerant) add_bumper_defaults(model);
    model.xml = print_xml(entry.original);
    if (holds_include(entry.original)) model.expanded_xml = print_xml(element);
    models.push_back(std::move(model));
  }
  return models;
}

}  // namespace angen::load
