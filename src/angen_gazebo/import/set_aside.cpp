#include <algorithm>
#include <optional>
#include <utility>

#include "document/xml.h"
#include "import/gazebo.h"

namespace angen::load {

namespace {

constexpr int kMostErrors = 1000;

// An error, and what was left out because of it.
struct Finding {
  Diagnostic error;
  std::vector<Source> around;  // the elements around it
  std::string left_out;
};

bool is_same(const Source& a, const Source& b) {
  return a.element != 0 && a.element == b.element && a.file == b.file;
}

// The way from `element` down to the innermost one of that place; empty if there is none.
std::vector<Element*> way_to(const Source& place, Element& element) {
  for (Element& child : element.children) {
    std::vector<Element*> way = way_to(place, child);
    if (way.empty()) continue;
    way.insert(way.begin(), &element);
    return way;
  }
  if (is_same(element.source, place)) return {&element};
  return {};
}

// Whether an element is the shape of a <geometry>, or one outline of it.
bool is_shape(const Element& element, const Element& geometry) {
  const Element& first = geometry.children.front();
  return geometry.name == "geometry" &&
         (&element == &first || (first.name == "polyline" && element.name == first.name));
}

// Removes the last element of a way. A part of a link without a shape means nothing, so it is
// removed with its shape.
void remove_end(std::vector<Element*> way, Finding& finding) {
  if (way.size() > 3 && is_shape(*way.back(), *way[way.size() - 2])) way.resize(way.size() - 2);
  const Element* end = way.back();
  way.pop_back();
  finding.left_out = tag_of(*end);
  finding.around.clear();
  for (const Element* each : way) finding.around.push_back(each->source);
  auto& all = way.back()->children;
  all.erase(all.begin() + (end - all.data()));
}

void tell(const Finding& finding, Session& session) {
  const auto& [severity, source, message] = finding.error;
  session.set_aside.emplace_back(source, message);
  session.warn(source, message + "; " + finding.left_out + " is left out");
}

// Returns the last error, if a root itself must be left out.
std::optional<Finding> try_to_read(const std::vector<Element*>& roots, Session& session,
                                   const std::function<void()>& read) {
  std::optional<Finding> finding;
  for (int errors = 0;; ++errors) {
    try {
      read();
      if (finding) tell(*finding, session);
      return std::nullopt;
    } catch (const LimitError&) {
      throw;
    } catch (const Error& error) {
      if (errors == kMostErrors) throw;
      const Diagnostic& first = error.diagnostics().front();
      const bool follows =
          finding && std::any_of(finding->around.begin(), finding->around.end(),
                                 [&](const Source& each) { return is_same(each, first.source); });
      if (finding && !follows) tell(*finding, session);
      if (!follows) finding = Finding{first, {}, ""};
      std::vector<Element*> way;
      for (Element* root : roots) {
        session.forget(*root);
        if (way.empty()) way = way_to(first.source, *root);
      }
      if (way.size() < 2) {
        finding->left_out = tag_of(way.empty() ? *roots.front() : *way.front());
        return finding;
      }
      remove_end(std::move(way), *finding);
    }
  }
}

}  // namespace

void Gazebo::report(const Error& error, Session& session) const {
  session.set_aside.push_back(error);
  for (const Diagnostic& each : error.diagnostics()) session.warn(each.source, each.message);
}

// Reads again without the smallest element that leaves the rest readable; a warning has the error
// and names what is left out.
bool Gazebo::read(const std::vector<Element*>& roots, Session& session,
                  const std::function<void()>& read) const {
  const std::optional<Finding> last = try_to_read(roots, session, read);
  if (last) tell(*last, session);
  return !last;
}

}  // namespace angen::load
