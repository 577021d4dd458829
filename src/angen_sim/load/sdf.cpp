#include "load/sdf.h"

#include <console_bridge/console.h>
#include <malloc.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "load/xml.h"

namespace angen::load {

namespace {

std::mutex& console_mutex() {
  static std::mutex mutex;
  return mutex;
}

// What libsdformat need not see: plug-ins (they check their own parameters), what `load` reads
// itself, and what later versions dropped.
bool hidden(const Element& element, const std::string& parent) {
  static const std::set<std::string> names = {"plugin",   "state",   "gui",
                                              "inertial", "include", "initial_position"};
  return names.count(element.name) != 0 || (element.name == "script" && parent == "material") ||
         element.name.find(':') != std::string::npos;
}

Element bare(const Element& element) {
  Element copy;
  copy.name = element.name;
  copy.text = element.text;
  copy.attributes = element.attributes;
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

void collect_names(const Element& element, std::set<std::string>& names) {
  names.insert(element.name);
  for (const Element& child : element.children) collect_names(child, names);
}

// What a document may lack without libsdformat querying its schema for a default. Without the
// others some of its classes would follow a null pointer (a camera sensor's without <camera>).
bool may_be_pruned(const std::string& name) {
  static const std::set<std::string> names = {"sensor",    "light",      "particle_emitter",
                                              "projector", "audio_sink", "audio_source",
                                              "battery",   "plugin",     "material",
                                              "surface",   "actor",      "joint",
                                              "gripper",   "empty",      "box",
                                              "capsule",   "cylinder",   "ellipsoid",
                                              "polyline",  "heightmap",  "mesh",
                                              "plane",     "sphere"};
  return names.count(name) != 0;
}

// A schema without what may be pruned, but for elements of the given names.
sdf::ElementPtr pruned(const sdf::ElementPtr& schema, const std::set<std::string>& names) {
  sdf::ElementPtr kept(new sdf::Element());
  kept->SetName(schema->GetName());
  kept->SetRequired(schema->GetRequired());
  kept->SetCopyChildren(schema->GetCopyChildren());
  kept->SetReferenceSDF(schema->ReferenceSDF());
  for (const sdf::ParamPtr& attribute : schema->GetAttributes()) {
    kept->AddAttribute(attribute->GetKey(), attribute->GetTypeName(),
                       attribute->GetDefaultAsString(), attribute->GetRequired());
  }
  if (const sdf::ParamPtr value = schema->GetValue()) {
    kept->AddValue(value->GetTypeName(), value->GetDefaultAsString(), value->GetRequired(),
                   value->GetMinValueAsString().value_or(""),
                   value->GetMaxValueAsString().value_or(""));
  }
  for (std::size_t i = 0; i < schema->GetElementDescriptionCount(); ++i) {
    const sdf::ElementPtr child = schema->GetElementDescription(static_cast<unsigned>(i));
    if (names.count(child->GetName()) != 0 || !may_be_pruned(child->GetName())) {
      kept->AddElementDescription(pruned(child, names));
    }
  }
  return kept;
}

// libsdformat copies an element's schema, with all that might be below it, for each element that it
// reads: a megabyte a link. It gets the part of the schema that `document` uses. Under Hush's lock.
sdf::SDFPtr empty_document(const Element& document) {
  static const sdf::SDFPtr schema = [] {
    sdf::SDFPtr all(new sdf::SDF());
    sdf::init(all);
    return all;
  }();
  std::set<std::string> names;
  collect_names(document, names);
  sdf::SDFPtr fresh(new sdf::SDF());
  fresh->Root(pruned(schema->Root(), names));
  return fresh;
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

// For errors without a line libsdformat names what it means in brackets, "link with name[a] … in
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

}  // namespace

struct Hush::Impl : console_bridge::OutputHandler {
  std::lock_guard<std::mutex> lock{console_mutex()};
  std::ostringstream text;
  std::ostream* before = nullptr;

  void log(const std::string& line, console_bridge::LogLevel, const char*, int) override {
    text << line << '\n';
  }
};

Hush::Hush() : impl_(std::make_unique<Impl>()) {
  auto& stream = sdf::Console::Instance()->GetMsgStream();
  impl_->before = stream.GetStream();
  stream.SetStream(&impl_->text);
  console_bridge::useOutputHandler(impl_.get());
}

Hush::~Hush() {
  console_bridge::restorePreviousOutputHandler();
  sdf::Console::Instance()->GetMsgStream().SetStream(impl_->before);
}

Memory::~Memory() { malloc_trim(0); }

std::string Hush::messages() const { return impl_->text.str(); }

// Why it gets a printed tree and not the file: its Element::LineNumber and FilePath are right for
// what stands in a file, included files too, but missing for elements that it does not know (all of
// a plug-in's parameters), for an include's pose and for defaults, and 0 for what an upgrade from
// an older version moves. Messages with file and line need a tree of our own; see print_xml's
// lines.
sdf::Root parse_world(const Element& world, Session& session) {
  Element document;
  document.name = "sdf";
  document.source = world.source;
  document.attributes = {{"version", "1.9"}};
  document.children = {bare(world)};
  std::vector<Source> lines;
  const std::string text = print_xml(document, 0, &lines);

  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::LOG);
  const sdf::SDFPtr parsed = empty_document(document);
  sdf::Errors errors;
  sdf::readString(text, config, parsed, errors);
  sdf::Root root;
  const sdf::Errors more = root.Load(parsed, config);
  errors.insert(errors.end(), more.begin(), more.end());
  for (const sdf::Error& error : errors) {
    if (error.Code() == sdf::ErrorCode::ELEMENT_INCORRECT_TYPE) {
      session.warn(source_of(error, lines), one_line(error.Message()));
      continue;
    }
    const Source at =
        error.LineNumber() ? source_of(error, lines) : named_in(error.Message(), world);
    throw Error(at, one_line(error.Message()));
  }
  if (root.WorldCount() != 1) throw Error(world.source, "libsdformat finds no world in it");
  return root;
}

Pose resolve(const sdf::SemanticPose& pose, const std::string& frame, const Source& at) {
  ignition::math::Pose3d resolved;
  const sdf::Errors errors = pose.Resolve(resolved, frame);
  if (!errors.empty()) throw Error(at, one_line(errors.front().Message()));
  return to_pose(resolved);
}

Pose to_pose(const ignition::math::Pose3d& pose) {
  const auto& q = pose.Rot();
  return {to_vec(pose.Pos()), Quat(q.W(), q.X(), q.Y(), q.Z()).normalized()};
}

Vec3 to_vec(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

}  // namespace angen::load
