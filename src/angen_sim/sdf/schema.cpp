#include "sdf/schema.h"

#include <malloc.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "document/tolerance.h"
#include "document/xml.h"
#include "import/libsdformat.h"
#include "sdf/vocabulary.h"

namespace angen::load {

namespace {

// libsdformat need not see plug-ins, which check their own parameters, elements that a later
// version of SDF dropped, and values that a Reader checks otherwise.
bool hidden(const Element& element, const std::string& parent) {
  static const std::set<std::string> names = {"plugin",
                                              "state",
                                              "gui",
                                              "inertial",
                                              "include",
                                              "initial_position",
                                              "restitution_coefficient"};
  return names.count(element.name) != 0 || (element.name == "script" && parent == "material") ||
         element.name.find(':') != std::string::npos;
}

Element bare(const Element& element) {
  Element copy;
  copy.name = element.name;
  copy.text = element.text;
  for (const auto& attribute : element.attributes) {
    if (attribute.first != kStrict) copy.attributes.push_back(attribute);
  }
  copy.source = element.source;
  for (const Element& child : element.children) {
    if (!hidden(child, element.name)) copy.children.push_back(bare(child));
    // Its classes have no such shape.
    if (child.name == "image" && element.name == "geometry") {
      copy.children.back() = Element{"empty", "", {}, {}, child.source};
    }
  }
  return copy;
}

// libsdformat gets a model's parts in pieces of at most this many elements, each of which takes
// some kilobytes there.
constexpr std::size_t kPieceElements = 2'000;

// `world` in pieces: its settings with the first, a large model in several.
std::vector<Element> pieces_of(const Element& world) {
  Element empty = bare(Element{world.name, "", world.attributes, {}, world.source});
  std::vector<Element> pieces = {empty};
  std::size_t size = 0;
  const auto make_room = [&](std::size_t more) {
    const bool full = size > 0 && size + more > kPieceElements;
    if (full) pieces.push_back(empty);
    size = full ? more : size + more;
    return full;
  };
  for (const Element& child : world.children) {
    const std::size_t count = count_elements(child);
    if (child.name != "model" || count <= kPieceElements) {
      make_room(count);
      pieces.back().children.push_back(bare(child));
      continue;
    }
    const Element model = bare(Element{child.name, child.text, child.attributes, {}, child.source});
    pieces.back().children.push_back(model);
    for (const Element& part : child.children) {
      if (hidden(part, child.name)) continue;
      if (make_room(count_elements(part))) pieces.back().children.push_back(model);
      pieces.back().children.back().children.push_back(bare(part));
    }
  }
  return pieces;
}

// "XML Element[waypont], child of element[trajectory], not defined in SDF. …" in our words, where
// there is an element that is near; else empty.
std::string misspelled_in(const std::string& message) {
  const auto bracketed = [&](const std::string& before) -> std::string {
    const std::size_t at = message.find(before + "[");
    if (at == std::string::npos) return "";
    const std::size_t begin = at + before.size() + 1;
    return message.substr(begin, message.find(']', begin) - begin);
  };
  if (message.find("not defined in SDF") == std::string::npos) return "";
  return misspelling(bracketed("XML Element"), bracketed("child of element"));
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() > 300 ? text.substr(0, 300) + " …" : text;
}

Source source_of(const sdf::Error& error, const std::vector<Source>& lines) {
  const int line = error.LineNumber().value_or(0);
  if (line >= 1 && static_cast<std::size_t>(line) <= lines.size()) {
    return lines[static_cast<std::size_t>(line) - 1];
  }
  return lines.empty() ? Source{} : lines.front();
}

// In errors without a line libsdformat names the element in brackets, "link with name[a] … in
// model with name[m]": the model is found first, then the part of it.
Source named_in(const std::string& message, const Element& world) {
  std::vector<std::string> names;
  for (std::size_t at = message.find("name[", 0); at != std::string::npos;
       at = message.find("name[", at)) {
    at += 5;
    names.push_back(message.substr(at, message.find(']', at) - at));
  }
  const auto named = [&](const Element& element) {
    return std::find(names.begin(), names.end(), name_of(element)) != names.end();
  };
  const Element* model = world.children.size() == 1 ? &world.children.front() : nullptr;
  for (const Element& child : world.children) {
    if (named(child)) model = &child;
  }
  if (model == nullptr) return world.source;
  for (const Element& part : model->children) {
    if (!name_of(part).empty() && named(part)) return part.source;
  }
  return model->source;
}

// It gets a printed tree and not the file: its Element::LineNumber and FilePath are right for
// elements of a file, included files too, but missing for elements that it does not know (all of
// a plug-in's parameters), for an include's pose and for defaults, and 0 for elements that an
// upgrade from an older version moves. Messages with file and line need a tree of our own; see
// print_xml's lines.
void check_piece(const Element& world, Session& session) {
  Element document;
  document.name = "sdf";
  document.source = world.source;
  document.attributes = {{"version", "1.9"}};
  document.children = {world};
  std::vector<Source> lines;
  const std::string text = print_xml(document, 0, &lines);
  std::set<std::string> names;
  collect_names(document, names);

  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::LOG);
  sdf::Errors errors;
  const sdf::SDFPtr parsed = empty_document(names);
  sdf::readString(text, config, parsed, errors);
  for (const sdf::Error& error : errors) {
    const Source at =
        error.LineNumber() ? source_of(error, lines) : named_in(error.Message(), world);
    const std::string meant = misspelled_in(error.Message());
    if (!meant.empty()) {
      session.warn_or_throw(Error(at, meant));
    } else if (error.Code() == sdf::ErrorCode::ELEMENT_INCORRECT_TYPE) {
      session.warn(at, one_line(error.Message()));
    } else {
      session.warn_or_throw(Error(at, one_line(error.Message())));
    }
  }
}

}  // namespace

void check_schema(const Element& world, Session& session) {
  {
    const SilenceConsole silence;
    for (const Element& piece : pieces_of(world)) check_piece(piece, session);
  }
  malloc_trim(0);
}

}  // namespace angen::load
