#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/diagnostics.h"

namespace angen {

/// An XML element as plain values. Plug-ins read their parameters from it.
struct Element {
  std::string name;
  std::string text{};  // trimmed
  std::vector<std::pair<std::string, std::string>> attributes{};
  std::vector<Element> children{};
  Source source{};

  const Element* child(const std::string& child_name) const {
    for (const Element& c : children) {
      if (c.name == child_name) return &c;
    }
    return nullptr;
  }
  /// The text of a child, or `fallback` when there is none.
  std::string child_text(const std::string& child_name, const std::string& fallback = "") const {
    const Element* found = child(child_name);
    return found == nullptr ? fallback : found->text;
  }
  const std::string* attribute(const std::string& key) const {
    for (const auto& [k, v] : attributes) {
      if (k == key) return &v;
    }
    return nullptr;
  }
  /// The text of an attribute, "" when there is none.
  std::string attribute_text(const std::string& key) const {
    const std::string* found = attribute(key);
    return found == nullptr ? "" : *found;
  }
};

}  // namespace angen
