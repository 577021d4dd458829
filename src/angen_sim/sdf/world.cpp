#include <algorithm>
#include <filesystem>
#include <map>

#include "core/alike.h"
#include "core/names.h"
#include "document/search.h"
#include "document/tolerance.h"
#include "document/values.h"
#include "document/xml.h"
#include "import/shorthand.h"
#include "sdf/cache.h"
#include "sdf/check.h"
#include "sdf/describe.h"
#include "sdf/entry.h"
#include "sdf/frames.h"
#include "sdf/light.h"
#include "sdf/load.h"
#include "sdf/reader.h"
#include "sdf/schema.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

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
    if (child.name == "population" || child.name == "road") {
      for (Element& model : child.name == "road" ? std::vector<Element>{road_model(child)}
                                                 : population_models(child)) {
        parts.entries.push_back(expand_entry(model, session));
      }
      continue;
    }
    if (child.name != "model" && child.name != "actor" && child.name != "include") {
      parts.settings.children.push_back(child);
      continue;
    }
    Entry entry;
    try {
      entry = expand_entry(child, session);
    } catch (const Error& error) {
      warn_or_throw_missing(child, error, session);
      continue;
    }
    if (entry.expanded.name == "model" && !session.guessed && !has_link(entry.expanded)) {
      session.warn_or_throw(
          Error(child.source, tag_of(entry.expanded) + " has no <link>; give it one"));
      continue;
    }
    if (entry.expanded.name == "light") {
      parts.settings.children.push_back(entry.expanded);
    } else {
      parts.entries.push_back(std::move(entry));
    }
  }
  return parts;
}

bool is_tolerant(const Element& given, const Parts& parts, const SearchPaths& paths) {
  if (const std::optional<bool> strict = marked_strict(given)) return !*strict;
  if (paths.strictness != Strictness::kAuto) return paths.strictness == Strictness::kTolerant;
  return !holds_own_plugin(parts.settings) &&
         std::none_of(parts.entries.begin(), parts.entries.end(),
                      [](const Entry& entry) { return holds_own_plugin(entry.expanded); });
}

// The parts of a world, and whether it is tolerant, which its own texts then say.
Parts split_and_decide(const Element& given, Session& session) {
  const bool strict = session.paths.strictness == Strictness::kStrict;
  session.tolerant = !marked_strict(given).value_or(strict);
  const bool guesses = !marked_strict(given) && session.paths.strictness == Strictness::kAuto;
  session.guessed = guesses || marked_guessed(given);
  Parts parts = split(given, session);
  session.decide(is_tolerant(given, parts, session.paths));
  if (!session.tolerant) return parts;
  set_attribute(parts.settings, kStrict, session.guessed ? kGuessed : "false");
  return parts;
}

bool holds_tolerant_model(const Parts& parts) {
  return std::any_of(parts.entries.begin(), parts.entries.end(),
                     [](const Entry& entry) { return marked_strict(entry.original) == false; });
}

// If tolerant, keeps the first of two models of one name.
void check_entry_names(std::vector<Entry>& entries, Session& session) {
  std::map<std::string, Source> seen;
  std::vector<Entry> kept;
  for (Entry& entry : entries) {
    const std::string name = name_of(entry.expanded);
    check_name(name, "<" + entry.expanded.name + ">", entry.original.source);
    const auto [there, fresh] = seen.insert({name, entry.original.source});
    if (!fresh) {
      const Error twice(entry.original.source,
                        "a model named '" + name + "' exists already, at line " +
                            std::to_string(there->second.line) + "; give this one another <name>");
      if (session.guessed) throw Error(twice);
      session.warn_or_throw(twice);
      continue;
    }
    kept.push_back(std::move(entry));
  }
  entries = std::move(kept);
}

// Most models need only their names and poses.
void place_all(const Parts& parts, desc::World& to, Session& session) {
  Element world = parts.settings;
  for (const Entry& entry : parts.entries) {
    if (entry.expanded.attribute("placement_frame") != nullptr) {
      world.children.push_back(entry.expanded);  // placed by a frame of its own
      continue;
    }
    Element model;
    model.name = "model";
    model.source = entry.original.source;
    model.attributes = {{"name", name_of(entry.expanded)}};
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

desc::World describe_world(const Element& sdf, Session& session) {
  const Element& given = only_world(sdf);
  Parts parts = split_and_decide(given, session);
  if (name_of(given).empty()) throw Error(given.source, "<world> has no name; write name=\"home\"");
  const std::string problem = label_problem(name_of(given));
  if (!problem.empty()) throw Error(given.source, "<world>: " + problem);
  check_settings(parts.settings, session);
  check_entry_names(parts.entries, session);

  desc::World world;
  world.tolerant = session.tolerant;
  session.tolerant = session.tolerant || holds_tolerant_model(parts);
  world.name = name_of(given);
  world.xml = print_xml(parts.settings);
  read_settings(parts.settings, world, session);
  world.models = describe_entries(parts.entries, session);
  place_all(parts, world, session);
  check_schema(parts.settings, session);
  for (const Element& child : sdf.children) {
    if (child.name != "world") session.ignore(child.source, "<" + child.name + "> in <sdf>");
  }
  note_ignored(parts.settings, session);
  for (const Element& state : parts.states) {
    apply_state(state, world, session);
    note_ignored(state, session);
  }
  world.warnings = merge_alike(session.warnings);
  world.ignored = session.ignored;
  return world;
}

SearchPaths paths_beside(const std::string& path, bool allow_any) {
  SearchPaths paths =
      SearchPaths::from_environment((fs::absolute(path).parent_path() / "models").string());
  paths.allow_any = paths.allow_any || allow_any;
  return paths;
}

desc::World read_world(const std::string& xml, const std::string& name, Session& session) {
  const Open open(session, name);
  session.tolerant = session.paths.strictness != Strictness::kStrict;  // until it is read
  return describe_world(read_document(xml, name, session), session);
}

}  // namespace

desc::World world_from_text(const std::string& xml, const std::string& name,
                            const SearchPaths& paths) {
  Session session{paths};
  return read_world(xml, name, session);
}

std::string world_text(const std::string& path, bool allow_any) {
  const SearchPaths paths = paths_beside(path, allow_any);
  Session session{paths};
  const Open open(session, path);
  session.tolerant = paths.strictness != Strictness::kStrict;
  const Element given = read_document(session.sources.read(path), path, session);
  Parts parts = split_and_decide(only_world(given), session);
  Element world = std::move(parts.settings);
  for (Entry& entry : parts.entries) world.children.push_back(std::move(entry.expanded));
  for (Element& state : parts.states) world.children.push_back(std::move(state));
  Element sdf;
  sdf.name = "sdf";
  sdf.attributes = {{"version", "1.9"}};
  sdf.children.push_back(std::move(world));
  return print_xml(sdf);
}

desc::World world(const std::string& path, bool allow_any) {
  const SearchPaths paths = paths_beside(path, allow_any);
  const Cache cache(path, paths);
  if (std::optional<desc::World> kept = cache.recall()) return *std::move(kept);
  Session session{paths};
  desc::World world = read_world(session.sources.read(path), path, session);
  if (session.tolerated.empty()) cache.keep(world, session.sources);
  return world;
}

}  // namespace angen::load
