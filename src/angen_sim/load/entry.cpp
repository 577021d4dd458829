#include "load/entry.h"

#include "load/check.h"
#include "load/describe.h"
#include "load/xml.h"

namespace angen::load {

namespace {

constexpr std::size_t kMaxModelElements = 20'000;

bool holds_include(const Element& element) {
  if (element.name == "include") return true;
  for (const Element& child : element.children) {
    if (child.name == "model" || child.name == "include") {
      if (holds_include(child)) return true;
    }
  }
  return false;
}

// What decides a model's description: all but its name, pose and plug-ins, and where it was
// written.
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

}  // namespace

Entry expand_entry(const Element& element, Session& session) {
  Entry entry{element, element};
  if (element.name == "include") entry.expanded = expand_include(element, session);
  if (element.name == "model") expand_model(entry.expanded, session);
  return entry;
}

desc::Model Describer::describe_once(const Element& model) {
  const std::string key = key_of(model);
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  Element bare = model;
  remove_children(bare, "plugin");
  return known_.emplace(key, describe_model(bare, session_)).first->second;
}

desc::Model Describer::describe(Entry& entry) {
  Element& element = entry.expanded;
  if (count_elements(element) > kMaxModelElements) {
    throw Error(entry.original.source, "more than " + std::to_string(kMaxModelElements) +
                                           " elements in one model; split it into several");
  }
  desc::Model model;
  if (element.name == "actor") {
    model = describe_actor(element, session_);
  } else if (element.name == "model") {
    check_model(element, session_);
    model = describe_once(element);
    for (const Element& child : element.children) {
      if (child.name == "plugin") model.plugins.push_back(plugin_of(child));
    }
  } else {
    throw Error(element.source, "<" + element.name +
                                    "> is no model; give <model>, <include> or "
                                    "<actor>");
  }
  model.name = name_of(element);
  model.source = entry.original.source;
  model.xml = print_xml(entry.original);
  if (holds_include(entry.original)) model.expanded_xml = print_xml(element);
  return model;
}

}  // namespace angen::load
