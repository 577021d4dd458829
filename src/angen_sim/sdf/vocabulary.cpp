#include "sdf/vocabulary.h"

#include <map>
#include <set>
#include <vector>

#include "core/nearest.h"
#include "document/xml.h"
#include "import/libsdformat.h"

namespace angen::load {

namespace {

/// The children that SDF's own description has for elements of a name, wherever they are.
class Vocabulary {
 public:
  Vocabulary() { read("root.sdf"); }

  const std::set<std::string>* children(const std::string& parent) const {
    const auto found = children_.find(parent);
    return found == children_.end() ? nullptr : &found->second;
  }

 private:
  /// The name of the element that a file describes.
  std::string read(const std::string& file) {
    const auto [there, fresh] = roots_.insert({file, ""});
    if (!fresh) return there->second;
    const std::string& text = sdf::SDF::EmbeddedSpec(file, true);
    if (text.empty()) return "";
    const Element root = parse_xml(text, file);
    roots_[file] = name_of(root);
    take(root);
    return name_of(root);
  }

  void take(const Element& described) {
    std::set<std::string> names;
    for (const Element& child : described.children) {
      if (child.name == "element" && !name_of(child).empty()) {
        names.insert(name_of(child));
        take(child);
      } else if (const std::string* file = child.attribute("filename")) {
        names.insert(read(*file));
      }
    }
    children_[name_of(described)].insert(names.begin(), names.end());
  }

  std::map<std::string, std::string> roots_;  // by file
  std::map<std::string, std::set<std::string>> children_;
};

std::size_t most_edits(const std::string& name) { return name.size() < 5 ? 1 : 2; }

}  // namespace

std::string meant_element(const std::string& name, const std::string& parent) {
  static const Vocabulary vocabulary;
  const std::set<std::string>* known = vocabulary.children(parent);
  if (known == nullptr || known->count(name) != 0) return "";
  const std::vector<std::string> nearest = nearest_names(name, {known->begin(), known->end()}, 1);
  return !nearest.empty() && edits(name, nearest.front()) <= most_edits(name) ? nearest.front()
                                                                              : "";
}

std::string misspelling(const std::string& name, const std::string& parent) {
  const std::string meant = meant_element(name, parent);
  if (meant.empty()) return "";
  return "<" + name + "> in <" + parent + "> is not known; did you mean <" + meant + ">?";
}

}  // namespace angen::load
