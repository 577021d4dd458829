#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "core/alike.h"
#include "core/limits.h"
#include "core/named.h"
#include "core/names.h"
#include "core/text.h"
#include "document/dialect.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/check.h"
#include "sdf/describe.h"
#include "sdf/entry.h"
#include "sdf/frames.h"
#include "sdf/home.h"
#include "sdf/load.h"
#include "sdf/reader.h"

namespace angen::load {

const Element* chosen_physics(const Element& world) {
  const Element* chosen = nullptr;
  for (const Element& child : world.children) {
    if (child.name != "physics") continue;
    const std::string marked = child.attribute_text("default");
    if (chosen == nullptr || marked == "true" || marked == "1") chosen = &child;
  }
  return chosen;
}

namespace {

void read_physics(const Reader& element, desc::Physics& physics, Session& session) {
  const std::string* type = element.attribute("type");
  element.attribute("default");
  if (type != nullptr && *type != "ode" && *type != "ignored") {
    session.warn(
        element.element().source,
        "<physics type=\"" + *type + "\">: ODE is used, the one engine here; write type=\"ode\"");
  }
  const Range step = Range::positive({"s", 1.0, 1e-9});
  if (const auto seconds = element.number("max_step_size", step)) {
    physics.step = from_seconds(*seconds);
  }
  physics.real_time_factor =
      element.number("real_time_factor", physics.real_time_factor, Range::not_negative({"", 1e6}));
  // SDF's way to say "as fast as possible".
  if (element.number("real_time_update_rate", Range::not_negative()) == 0.0) {
    physics.real_time_factor = 0.0;
  }
  const Reader ode = element.block("ode");
  const Range iterations = Range::solver(1.0, 1e4, Range::Sign::kPositive);
  physics.iterations =
      static_cast<int>(ode.block("solver").number("iters", physics.iterations, iterations));
  const Element* solver = ode.block("solver").child("type");  // the exact one, as here
  if (solver != nullptr && solver->text != "world") {
    session.ignore(solver->source, "<type> in <solver>");
  }
  const Reader constraints = ode.block("constraints");
  physics.erp = constraints.number("erp", physics.erp, Range::solver(0.0, 1.0));
  physics.cfm = constraints.number("cfm", physics.cfm, Range::solver(0.0, 1e6));
  physics.contact_max_correcting_vel =
      constraints.number("contact_max_correcting_vel", physics.contact_max_correcting_vel,
                         Range::solver(0.0, limits::kSpeed.most));
  physics.contact_surface_layer = constraints.number(
      "contact_surface_layer", physics.contact_surface_layer, Range::solver(0.0, 1.0));
}

/// Physics, gravity and scene out of a checked <world>.
void read_settings(const Element& element, desc::World& to, Session& session) {
  const Reader world(element, session);
  if (const Element* physics = chosen_physics(element)) {
    read_physics({*physics, session}, to.physics, session);
  }
  to.gravity = world.vector("gravity", to.gravity, Range::any(limits::kGravity));
  const Reader atmosphere = world.block("atmosphere");
  atmosphere.attribute("type");
  to.ambient_temperature = atmosphere.number("temperature", to.ambient_temperature,
                                             Range::positive(limits::kTemperature));
  const Reader scene = world.block("scene");
  if (const auto ambient = scene.color("ambient")) to.scene.ambient = *ambient;
  if (const auto background = scene.color("background")) to.scene.background = *background;
  to.scene.shadows = scene.flag("shadows", to.scene.shadows);
  for (const Element& child : element.children) {
    if (child.name == "frame") Reader(child, session).attribute("attached_to");
    if (child.name == "plugin") to.plugins.push_back(plugin_of(child));
  }
  world.note({"plugin"});
  read_home_parts(world, Pose{}, to.home, session);
  to.site = home_site_of(world, session);
}

template <class T>
T& find_named(std::vector<T>& all, const Element& element, const std::string& where) {
  const std::string name = name_of(element);
  if (const auto found = index_in(all, name)) return all[*found];
  throw Error(element.source, "<state> names an unknown " + element.name + " '" + name + "'" +
                                  where + "; known are " + join_names(names_in(all)));
}

void apply_joint(const Element& element, desc::Joint& joint, Session& session) {
  Reader(element, session);
  for (const Element& angle : element.children) {
    if (angle.name != "angle") continue;
    const std::string* text = Reader(angle, session).attribute("axis");
    const std::size_t axis = text == nullptr || *text == "0" ? 0 : *text == "1" ? 1 : 2;
    if (axis >= joint.axes.size()) {
      throw Error(angle.source, tag_of(element) + " has " + std::to_string(joint.axes.size()) +
                                    " axes; there is no axis " + (text == nullptr ? "0" : *text));
    }
    const double position = number_of(angle);
    desc::JointAxis& to = joint.axes[axis];
    const std::string wrong = limit_problem(limits::kPosition, position);
    if (!wrong.empty()) {
      throw Error(angle.source, "the position of " + tag_of(element) + " is " +
                                    number_text(position) + "; " + wrong);
    }
    constexpr double kSlack = 1e-3;  // a joint at its stop may stand a little beyond it
    if (position < to.lower - kSlack || position > to.upper + kSlack) {
      throw Error(angle.source, "the position " + number_text(position) + " of " + tag_of(element) +
                                    " is outside its limits " + number_text(to.lower) + " … " +
                                    number_text(to.upper));
    }
    to.initial_position = position;
  }
}

void apply_model(const Element& element, desc::World& world, Session& session) {
  const Reader reader(element, session);
  desc::Model& model = find_named(world.models, element, "");
  if (const Element* pose = element.child("pose")) model.pose = pose_of(*pose);
  for (const Element& part : element.children) {
    if (part.name == "joint") {
      apply_joint(part, find_named(model.joints, part, " of model '" + model.name + "'"), session);
    }
  }
}

/// Applies the world's <state>: poses and joint positions. Throws Error for unknown names, unless
/// the dialect permits them.
void apply_state(const Element& state, desc::World& world, Session& session) {
  Reader(state, session).attribute("world_name");
  for (const Element& element : state.children) {
    if (element.name != "model") continue;
    try {
      apply_model(element, world, session);
    } catch (const Error& error) {
      session.warn_or_throw(error);
    }
  }
}

// Models and settings of a <world>, includes written out.
struct Parts {
  Element settings;  // the world without models, included lights written out
  std::vector<Entry> entries;
  std::vector<Element> states;
};

Parts split(const Element& world, Session& session) {
  Parts parts;
  parts.settings.name = world.name;
  parts.settings.source = world.source;
  parts.settings.attributes = world.attributes;
  for (const Element& child : world.children) {
    if (child.name == "state") {
      parts.states.push_back(child);
      continue;
    }
    const bool is_several = child.name == "population" || child.name == "road";
    if (!is_several && child.name != "model" && child.name != "actor" && child.name != "include") {
      parts.settings.children.push_back(child);
      continue;
    }
    Element part = child;
    std::vector<Entry> entries;
    session.read_without_errors({&part}, [&] {
      entries.clear();
      const std::vector<Element> models =
          is_several ? gazebo_dialect(part).models_of(part) : std::vector<Element>{part};
      for (const Element& each : models) {
        entries.push_back(expand_entry(each, session));
      }
    });
    for (Entry& entry : entries) {
      if (entry.expanded.name == "light") {
        parts.settings.children.push_back(std::move(entry.expanded));
      } else {
        parts.entries.push_back(std::move(entry));
      }
    }
  }
  return parts;
}

bool is_own(const Parts& parts) {
  return holds_own_plugin(parts.settings) ||
         std::any_of(parts.entries.begin(), parts.entries.end(),
                     [](const Entry& entry) { return holds_own_plugin(entry.expanded); });
}

bool holds_foreign_model(const Parts& parts) {
  return std::any_of(parts.entries.begin(), parts.entries.end(),
                     [](const Entry& entry) { return marked_strict(entry.original) == false; });
}

const Element& only_world(const Element& sdf) {
  const Element* found = nullptr;
  for (const Element& child : sdf.children) {
    if (child.name != "world") continue;
    if (found != nullptr) throw Error(child.source, "a second <world> in one file; keep one");
    found = &child;
  }
  if (found == nullptr) throw Error(sdf.source, "the file has no <world>; a world file needs one");
  return *found;
}

/// The parts of a world, as documents of a dialect have them.
struct Reading {
  Reading(const Element& document, const SearchPaths& paths, const Dialect& dialect)
      : session{paths, &dialect} {
    const Open open(session, document.source.file);
    const Element sdf = read_document(document, session);
    parts = split(only_world(sdf), session);
    if (&dialect != &own_dialect()) set_attribute(parts.settings, kStrict, "false");
    for (const Element& child : sdf.children) {
      if (child.name != "world") session.ignore(child.source, "<" + child.name + "> in <sdf>");
    }
  }

  Session session;
  Parts parts;
};

std::unique_ptr<Reading> read_parts(const std::string& xml, const std::string& name,
                                    const SearchPaths& paths) {
  const Element document = parse_xml(xml, name);
  const Element* given = document.child("world");
  const Element& world = given == nullptr ? document : *given;
  const auto read_as = [&](const Dialect& dialect) {
    return std::make_unique<Reading>(document, paths, dialect);
  };
  std::optional<bool> strict = marked_strict(world);
  if (!strict && paths.default_dialect != DefaultDialect::kAuto) {
    strict = paths.default_dialect == DefaultDialect::kOwn;
  }
  if (strict) return read_as(*strict ? own_dialect() : gazebo_dialect(world));
  std::optional<Error> wrong;  // in a document of ours
  try {
    std::unique_ptr<Reading> own = read_as(own_dialect());
    if (is_own(own->parts)) return own;
  } catch (const Error& error) {
    if (holds_own_plugin(world)) throw;
    wrong = error;
  }
  std::unique_ptr<Reading> gazebo = read_as(gazebo_dialect(world));
  if (wrong && is_own(gazebo->parts)) throw Error(*wrong);
  return gazebo;
}

// Keeps the first of two models of one name, if the dialect permits them.
void check_entry_names(std::vector<Entry>& entries, Session& session) {
  std::map<std::string, Source> seen;
  std::vector<Entry> kept;
  for (Entry& entry : entries) {
    const std::string name = name_of(entry.expanded);
    const bool named = session.read_without_errors({&entry.original}, [&] {
      check_name(name, "<" + entry.expanded.name + ">", entry.original.source);
    });
    if (!named) continue;
    const auto [there, fresh] = seen.insert({name, entry.original.source});
    if (!fresh) {
      session.warn_or_throw(Error(entry.original.source, "a model named '" + name +
                                                             "' exists already, at line " +
                                                             std::to_string(there->second.line) +
                                                             "; give this one another <name>"));
      continue;
    }
    kept.push_back(std::move(entry));
  }
  entries = std::move(kept);
}

// Most models need only their names and poses.
void place_all(const Parts& parts, desc::World& to, Session& session) {
  to.lights.clear();
  Element world = parts.settings;
  for (const Entry& entry : parts.entries) {
    if (entry.expanded.attribute("placement_frame") != nullptr) {
      world.children.push_back(entry.expanded);  // placed by a frame of its own
      continue;
    }
    Element model{"model", "", {{"name", name_of(entry.expanded)}}, {}, entry.original.source};
    if (const Element* pose = entry.expanded.child("pose")) model.children.push_back(*pose);
    world.children.push_back(std::move(model));
  }
  Frames frames(world);
  for (const Element& child : parts.settings.children) {
    if (child.name == "light") {
      to.lights.push_back(light_of(child, frames.part_pose(child, "", ""), session));
    }
  }
  for (std::size_t i = 0; i < parts.entries.size(); ++i) {
    const Element& element = parts.entries[i].expanded;
    if (element.name == "model") to.models[i].pose = frames.pose(name_of(element));
  }
}

desc::World describe_world(Reading& reading) {
  Session& session = reading.session;
  Parts& parts = reading.parts;
  const Source& at = parts.settings.source;
  const std::string name = name_of(parts.settings);
  if (name.empty()) {
    session.warn_or_throw(Error(at, "<world> has no name; write name=\"home\""));
  }
  const std::string problem = label_problem(name);
  if (!problem.empty()) throw Error(at, "<world>: " + problem);
  desc::World world;
  world.name = name;
  session.dialect->complete(world);
  world.xml = print_xml(parts.settings);
  const desc::World empty = world;
  desc::World settings = empty;
  const auto read = [&] {
    check_settings(parts.settings, session);
    settings = empty;
    read_settings(parts.settings, settings, session);
  };
  if (session.read_without_errors({&parts.settings}, read)) world = settings;
  check_entry_names(parts.entries, session);
  if (holds_foreign_model(parts)) session.dialect = &gazebo_dialect(parts.settings);
  world.models = describe_entries(parts.entries, session);
  std::vector<Element*> placed = {&parts.settings};
  for (Entry& entry : parts.entries) placed.push_back(&entry.expanded);
  const auto place = [&] {
    settings = empty;
    read_settings(parts.settings, settings, session);  // notes what is read, also of fewer elements
    place_all(parts, world, session);
  };
  if (!session.read_without_errors(placed, place)) {
    throw Error(at, "the models of this <world> cannot be placed");
  }
  note_ignored(parts.settings, session);
  for (Element& state : parts.states) {
    session.read_without_errors({&state}, [&] { apply_state(state, world, session); });
    note_ignored(state, session);
  }
  world.warnings = merge_alike(session.warnings);
  world.ignored = session.ignored;
  return world;
}

SearchPaths paths_beside(const std::string& path, bool allow_any) {
  return SearchPaths::from_environment(models_beside(path), allow_any);
}

}  // namespace

desc::World world_from_text(const std::string& xml, const std::string& name,
                            const SearchPaths& paths) {
  return describe_world(*read_parts(xml, name, paths));
}

std::string world_text(const std::string& path, bool allow_any) {
  const SearchPaths paths = paths_beside(path, allow_any);
  const std::unique_ptr<Reading> reading = read_parts(read_file(path), path, paths);
  Parts& parts = reading->parts;
  Element world = std::move(parts.settings);
  for (Entry& entry : parts.entries) world.children.push_back(std::move(entry.expanded));
  for (Element& state : parts.states) world.children.push_back(std::move(state));
  Element sdf{"sdf", "", {{"version", "1.9"}}};
  sdf.children.push_back(std::move(world));
  return print_xml(sdf);
}

desc::World world(const std::string& path, bool allow_any) {
  const std::string text = read_file(path);
  return world_from_text(text, path, paths_beside(path, allow_any));
}

}  // namespace angen::load
