#include "assets/collada.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <vector>

namespace angen::load {

namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kMaxNodes = 100'000;  // with all instances
constexpr int kMaxDepth = 500;

[[noreturn]] void reject(const XMLElement& at, const std::string& problem) {
  throw Rejected("cannot be read: line " + std::to_string(at.GetLineNum()) + " of it: " + problem);
}

std::string value(const XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  return text == nullptr ? "" : text;
}

class Nodes {
 public:
  explicit Nodes(std::size_t bytes) : bytes_(bytes) {}

  // Indexes every node below by id and name, and checks counts. <extra> is free-form and skipped.
  void collect(const XMLElement& element) {
    const std::string name = element.Name();
    if (name == "extra") return;
    if (const char* count = element.Attribute("count")) {
      char* end = nullptr;
      const long long number = std::strtoll(count, &end, 10);
      if (number < 0 || static_cast<std::size_t>(number) > bytes_) {
        reject(element, "<" + name + " count=\"" + std::string(count).substr(0, 40) +
                            "\"> is not the number of its elements");
      }
    }
    if (name == "node") {
      by_id_.insert({value(element, "id"), &element});
      by_name_.insert({value(element, "name"), &element});
    }
    for (auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
      collect(*child);
    }
  }

  struct Size {
    std::size_t nodes = 0;  // and shapes; 0 while it is being counted
    int depth = 0;
  };

  // The size of `element`, a node or a scene, with its instances; `above` nodes are around it.
  Size measure(const XMLElement& element, int above = 0) {
    const auto [known, fresh] = sizes_.insert({&element, {}});
    if (!fresh) {
      if (known->second.nodes != 0) return known->second;
      reject(element, "the node '" + value(element, "id") + "' instances itself");
    }
    Size size{1, 1};
    const auto add = [&](const XMLElement& part) {
      if (above >= kMaxDepth) too_deep(part);
      const Size more = measure(part, above + 1);
      size = {size.nodes + more.nodes, std::max(size.depth, more.depth + 1)};
    };
    for (auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
      const std::string name = child->Name();
      if (name == "node") {
        add(*child);
      } else if (name == "instance_node") {
        for (const XMLElement* instanced : named_by(*child)) add(*instanced);
      } else if (name == "instance_geometry" || name == "instance_controller") {
        ++size.nodes;
      }
      if (size.depth > kMaxDepth) too_deep(*child);
      if (size.nodes > kMaxNodes) {
        reject(*child,
               "its instances make more than " + std::to_string(kMaxNodes) + " nodes; simplify it");
      }
    }
    return sizes_[&element] = size;
  }

 private:
  [[noreturn]] static void too_deep(const XMLElement& at) {
    reject(at, "nodes are nested more than " + std::to_string(kMaxDepth) + " deep");
  }

  using Index = std::multimap<std::string, const XMLElement*>;

  // Resolved by id, otherwise by name, as by assimp.
  std::vector<const XMLElement*> named_by(const XMLElement& instance) const {
    std::string url = value(instance, "url");
    if (!url.empty() && url[0] == '#') url.erase(0, 1);
    const Index& index = by_id_.count(url) != 0 ? by_id_ : by_name_;
    std::vector<const XMLElement*> found;
    for (auto [at, end] = index.equal_range(url); at != end; ++at) found.push_back(at->second);
    return found;
  }

  std::size_t bytes_;
  Index by_id_;
  Index by_name_;
  std::map<const XMLElement*, Size> sizes_;
};

void count_all(const XMLElement& element, Nodes& nodes) {
  const std::string name = element.Name();
  if (name == "node" || name == "visual_scene") nodes.measure(element);
  for (auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
    count_all(*child, nodes);
  }
}

// Whether the contents of an <image> name a file or hold data, comments left out.
bool has_file(const std::string& inside) {
  for (std::size_t at = 0; (at = inside.find('<', at)) != std::string::npos; ++at) {
    const auto starts = [&](const std::string& what) {
      return inside.compare(at, what.size(), what) == 0;
    };
    if (starts("<init_from") || starts("<data")) return true;
    if (starts("<!--") && (at = inside.find("-->", at)) == std::string::npos) return false;
  }
  return false;
}

std::string id_in(const std::string& opening) {
  const std::size_t at = opening.find(" id=");
  if (at == std::string::npos || at + 5 >= opening.size()) return "unnamed";
  const std::size_t end = opening.find(opening[at + 4], at + 5);
  const std::string id = end == std::string::npos ? "" : opening.substr(at + 5, end - at - 5);
  return id.empty() ? "unnamed" : id;
}

}  // namespace

void check_collada(const std::string& text) {
  tinyxml2::XMLDocument document;
  document.Parse(text.data(), text.size());
  if (document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) {
    throw Rejected("cannot be read: line " + std::to_string(document.ErrorLineNum()) +
                   " of it: elements are nested more than 100 deep");
  }
  if (document.Error() || document.RootElement() == nullptr) {
    throw Rejected("cannot be read: line " + std::to_string(document.ErrorLineNum()) +
                   " of it is not well-formed XML");
  }
  Nodes nodes(text.size());
  nodes.collect(*document.RootElement());
  count_all(*document.RootElement(), nodes);
}

void name_images(std::string& text) {
  std::string named;
  std::size_t from = 0;
  for (std::size_t at = 0; (at = text.find("<image", at)) != std::string::npos;) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) break;
    const bool is_image = std::string(" \t\r\n/>").find(text[at + 6]) != std::string::npos;
    const bool is_empty = text[end - 1] == '/';
    const std::size_t stop = is_empty ? end - 1 : end;
    const std::size_t close = is_empty ? end + 1 : text.find("</image>", end);
    if (close == std::string::npos) break;
    const std::string opening = text.substr(at, stop - at);
    const std::string inside = is_empty ? "" : text.substr(end + 1, close - end - 1);
    at = close;
    if (!is_image || has_file(inside)) continue;
    named.append(text, from, stop - from);
    named += "><init_from>" + id_in(opening) + "</init_from>" + (is_empty ? "</image>" : inside);
    from = close;
  }
  if (from == 0) return;
  text = named.append(text, from, std::string::npos);
}

void trim_colors(std::string& text) {
  std::size_t to = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = text.find('>', text.find("<color", from));
    const std::size_t stop = end == std::string::npos ? text.size() : end + 1;
    std::copy(text.data() + from, text.data() + stop, text.data() + to);
    to += stop - from;
    from = std::min(text.find_first_not_of(" \t\r\n", stop), text.size());
  }
  text.resize(to);
}

}  // namespace angen::load
