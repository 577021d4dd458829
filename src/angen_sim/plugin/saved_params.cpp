#include "plugin/saved_params.h"

#include "core/lists.h"

namespace angen {

void SavedParams::write_to(Element& plugin) const {
  const auto is_saved = [this](const Element& child) { return names_.count(child.name) != 0; };
  auto& children = plugin.children;
  erase_if(children, is_saved);
  for (const auto& [name, text] : values_) {
    children.push_back({name, text, {}, {}, plugin.source});
  }
}

}  // namespace angen
