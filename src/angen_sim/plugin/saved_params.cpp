#include "plugin/saved_params.h"

#include <algorithm>

namespace angen {

void SavedParams::write_to(Element& plugin) const {
  const auto is_saved = [this](const Element& child) { return names_.count(child.name) != 0; };
  auto& children = plugin.children;
  children.erase(std::remove_if(children.begin(), children.end(), is_saved), children.end());
  for (const auto& [name, text] : values_) {
    Element child;
    child.name = name;
    child.text = text;
    child.source = plugin.source;
    children.push_back(std::move(child));
  }
}

}  // namespace angen
