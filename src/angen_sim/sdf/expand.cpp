#include "sdf/expand.h"

#include <filesystem>
#include <map>
#include <set>

#include "core/lists.h"
#include "core/names.h"
#include "document/search.h"
#include "document/xml.h"
#include "sdf/home.h"
#include "sdf/upgrade.h"

namespace angen::load {

namespace {

constexpr std::size_t kMaxDepth = 16;
constexpr std::size_t kMaxExpanded = 400'000;
constexpr std::size_t kMaxIncluded = 20'000;  // elements of a model, or dropped by includes

int version_of(const Element& sdf) {
  const std::string* text = sdf.attribute("version");
  if (text == nullptr) {
    throw Error(sdf.source, "<sdf> has no version; write <sdf version=\"1.6\">");
  }
  const int version = version_number(*text);
  if (version < 100 || version == 101 || version > 109) {
    throw Error(sdf.source,
                "SDF version '" + *text + "' is not read; versions 1.0 and 1.2 to 1.9 are");
  }
  return version;
}

void count(const Element& document, Session& session) {
  session.elements += count_elements(document);
  if (session.elements > kMaxExpanded) {
    throw LimitError(document.source,
                     "more than " + std::to_string(kMaxExpanded) +
                         " elements with all that is included; make the world smaller");
  }
  if (session.include_start && session.elements - *session.include_start > kMaxIncluded) {
    throw LimitError(document.source,
                     "more than " + std::to_string(kMaxIncluded) +
                         " elements in one <include> with all that it includes; split "
                         "it into several models");
  }
}

/// While the outermost include is read, its elements are counted.
class CountInclude {
 public:
  explicit CountInclude(Session& session) : session_(session), outermost_(!session.include_start) {
    if (outermost_) session_.include_start = session_.elements;
  }
  ~CountInclude() {
    if (outermost_) session_.include_start.reset();
  }
  CountInclude(const CountInclude&) = delete;
  CountInclude& operator=(const CountInclude&) = delete;

 private:
  Session& session_;
  bool outermost_;
};

// The one <model>, <actor> or <light> of an included document.
Element& included_root(Element& sdf) {
  Element* found = nullptr;
  for (Element& child : sdf.children) {
    if (child.name != "model" && child.name != "actor" && child.name != "light") continue;
    if (found != nullptr) {
      throw Error(child.source, "a second " + tag_of(child) + " in an included file; keep one");
    }
    found = &child;
  }
  if (found == nullptr) {
    throw Error(sdf.source,
                "an included file needs a <model>, an <actor> or a <light>; this has "
                "none");
  }
  return *found;
}

void check_given_once(const Element& include) {
  static const std::set<std::string> once = {"uri", "name", "pose", "placement_frame", "static"};
  std::map<std::string, Source> seen;
  for (const Element& child : include.children) {
    if (once.count(child.name) == 0) continue;
    const auto [first, fresh] = seen.insert({child.name, child.source});
    if (fresh) continue;
    throw Error(child.source, "a second <" + child.name + "> in one <include>, first at line " +
                                  std::to_string(first->second.line) + "; keep one");
  }
}

// The <plugin> that one of an <include> replaces; others of their library are their twins.
void remove_replaced(const Element& plugin, Element& from) {
  const std::string* file = plugin.attribute("filename");
  if (file == nullptr || !made_for_gazebo(*file)) return;
  auto& all = from.children;
  erase_if(all, [&](const Element& other) {
    const std::string* its = other.attribute("filename");
    return other.name == "plugin" && its != nullptr && *its == *file &&
           name_of(other) == name_of(plugin);
  });
}

void apply_include(const Element& include, Element& to, Session& session) {
  check_given_once(include);
  std::vector<Element> added;
  std::set<std::string> replaced;
  for (const Element& child : include.children) {
    if (child.name == "uri") continue;
    if (child.name == "name") {
      check_name(child.text, "<include>", child.source);
      set_attribute(to, "name", child.text);
    } else if (child.name == "pose") {
      remove_children(to, "pose");
      to.children.insert(to.children.begin(), child);
    } else if (child.name == "static") {
      remove_children(to, "static");
      to.children.insert(to.children.begin(), child);
    } else if (child.name == "plugin") {
      remove_replaced(child, to);
      added.push_back(child);
    } else if (is_of_home(child.name)) {
      if (replaced.insert(child.name).second) remove_children(to, child.name);
      added.push_back(child);
    } else if (child.name == "placement_frame") {
      set_attribute(to, "placement_frame", child.text);
    } else {
      session.warn(child.source, "an <include> has no <" + child.name +
                                     ">: it has no effect; it "
                                     "takes uri, name, pose, placement_frame, static and plugin");
    }
  }
  to.children.insert(to.children.end(), added.begin(), added.end());
}

// merge="true" adds these parts; the rest, such as <static>, is the outer model's own.
void merge_parts(Element& included, std::vector<Element>& into) {
  static const std::set<std::string> parts = {"link", "joint", "frame", "model", "plugin"};
  if (const Element* pose = included.child("pose")) {
    throw Error(pose->source,
                "a <pose> of a model that is included with merge is not supported; "
                "give it to the outer model");
  }
  for (Element& child : included.children) {
    if (parts.count(child.name) != 0 || is_of_home(child.name)) into.push_back(std::move(child));
  }
}

}  // namespace

bool is_merge(const Element& include) {
  const std::string* merge = include.attribute("merge");
  return merge != nullptr && *merge != "false" && *merge != "0";
}

Element read_document(Element root, Session& session) {
  if (root.name == "gazebo" && root.attribute("version") != nullptr) root.name = "sdf";  // to 1.2
  if (root.name == "robot") {
    session.converted.insert(root.source.file);
    root = gazebo_dialect(root).convert_urdf(std::move(root), session);
  }
  if (root.name != "sdf") {
    throw Error(root.source, "the file begins with <" + root.name +
                                 ">; it must begin with <sdf> or "
                                 "<robot>");
  }
  upgrade(root, version_of(root), session);
  make_uris_absolute(root, session);
  count(root, session);
  return root;
}

Element expand_include(const Element& include, Session& session) {
  const Element* uri = include.child("uri");
  if (uri == nullptr) {
    throw Error(include.source, "<include> has no <uri>; write <uri>model://NAME</uri>");
  }
  const std::string found = need_uri(uri->text, "model", uri->source, session);
  const std::string file = model_file(found, uri->source, session);
  std::error_code failed;
  std::string real = std::filesystem::canonical(file, failed).string();
  if (failed) real = file;
  if (is_in(real, session.open)) {
    throw Error(uri->source, "a cycle of includes: '" + uri->text +
                                 "' includes itself, by way of " + join_names(session.open));
  }
  if (session.open.size() >= kMaxDepth) {
    throw Error(uri->source,
                "includes are nested more than " + std::to_string(kMaxDepth) + " deep");
  }
  const Open open(session, real);
  const CountInclude counted(session);
  Element sdf = read_document(parse_xml(read_file(file), file), session);
  Element& root = included_root(sdf);
  if (root.name == "model") expand_model(root, session);
  apply_include(include, root, session);
  return std::move(root);
}

void expand_model(Element& model, Session& session) {
  std::vector<Element> expanded;
  for (Element& child : model.children) {
    if (child.name == "include") {
      Element included;
      const bool found = session.read_without_errors({&child}, [&] {
        included = expand_include(child, session);
        if (included.name == "model") return;
        throw Error(child.source, "an <include> in a <model> must name a <model>; this is <" +
                                      included.name + ">");
      });
      if (!found) continue;
      if (is_merge(child)) {
        merge_parts(included, expanded);
      } else {
        expanded.push_back(std::move(included));
      }
      continue;
    }
    if (child.name == "model") expand_model(child, session);
    expanded.push_back(std::move(child));
  }
  model.children = std::move(expanded);
}

}  // namespace angen::load
