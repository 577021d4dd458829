#pragma once

#include <string>
#include <utility>
#include <vector>

#include "desc/world.h"
#include "document/allowed.h"

/// SDF and URDF files to plain descriptions. Every function throws Error (file:line) and changes
/// nothing.
namespace angen::load {

/// The most memory, in MB, that a world or a model may be estimated to take: the environment's
/// ANGEN_MEMORY_LIMIT, 4096 without it, or the value set for this process.
double memory_limit();
void set_memory_limit(double megabytes);

/// A whole world file; worlds/models beside it is searched too. `allow_any` as in SearchPaths.
desc::World world(const std::string& path, bool allow_any = false);

/// A world from text; messages name `name` as its file.
desc::World world_from_text(const std::string& xml, const std::string& name,
                            const SearchPaths& paths);

/// A world file with its includes written out: it loads as the file does, but needs no other file
/// besides those that files_of() lists.
std::string world_text(const std::string& path, bool allow_any = false);

/// A file that a mesh, a heightmap or an image of a text is read from.
struct UsedFile {
  std::string uri;   // the URI in the text
  std::string path;  // where it is found, "" where it is not
};
std::vector<UsedFile> files_of(const std::string& xml, const SearchPaths& paths);
/// The text with those files read from these paths.
std::string with_files(const std::string& xml, const std::vector<UsedFile>& files);
/// A world of SDF 1.9 with nothing in it but this model.
std::string world_around(const desc::Model& model);

/// One model from a text (<sdf>, <model>, <include>, <actor>, or URDF <robot>), from a path, or
/// from a model:// uri; `name` replaces its own unless empty, `pose` is its pose in the
/// world (an actor's waypoints are relative to it). A lone element is read as SDF 1.6 or later.
/// `gazebo`: its dialect is Gazebo's, unless `paths` or its own angen:strict says otherwise.
desc::Model model(const std::string& what, const std::string& name, const Pose& pose,
                  const SearchPaths& paths, bool gazebo = false);

/// True when `what` is a lone <sensor> element (or an <sdf> around one) for sensor().
bool is_sensor(const std::string& what);

/// A <sensor> element, to be attached to a link; `name` replaces its own unless empty.
desc::Sensor sensor(const std::string& what, const std::string& name, const Pose& pose);

/// True when `what` is a lone <light> element (or an <sdf> around one) for light().
bool is_light(const std::string& what);
/// The <light> of a text made for Gazebo that only includes one, as one for `sun`; else "".
std::string included_light(const std::string& what, const SearchPaths& paths);

/// A <light> element as a light of the world's own, with `pose` before its own; `name` replaces its
/// own unless empty. It is a lamp.
desc::Light light(const std::string& what, const std::string& name, const Pose& pose);

/// A sensor that was attached to a link at run time.
struct AttachedSensor {
  std::string link;
  desc::Sensor sensor;
};

/// A light as it is now.
struct LightState {
  const desc::Light* light = nullptr;
  std::string link{};  // link of a model that it is in
  Element lamp{};      // parameters of its own lamp as children, where they are to be written
  std::string sdf{};   // the text that it was spawned from; "" for one in the world's text
};

/// The changes of a model since it was described.
struct ModelState {
  const desc::Model* model = nullptr;
  Pose pose;                                                                 // in the world
  std::vector<std::pair<std::string, std::vector<double>>> joint_positions;  // rad or m, by name
  std::vector<AttachedSensor> attached{};
  std::vector<Element> plugins{};     // plug-ins of devices, with their present parameters
  std::vector<LightState> lights{};   // whose lamps have other parameters than in the text
  const desc::Model* read = nullptr;  // what its text says, if that differs
};

/// The settings of a world that may have changed.
struct WorldState {
  desc::Physics physics;
  Vec3 gravity;
  std::vector<LightState> lights;  // all of the world's own
};

/// The world as SDF 1.9 that loads again: its settings as `now` has them, every live model where it
/// is now, sensors that were attached to links, inertials, gravity, lights and joints that were
/// changed (their model is then written out instead of included), plug-ins and lamps with the
/// parameters that they have now, the world's own lights, and a <state> with poses and joint
/// positions.
std::string save(const desc::World& world, const std::vector<ModelState>& models,
                 const WorldState& now);
/// The world with the settings that it was read with.
std::string save(const desc::World& world, const std::vector<ModelState>& models);

}  // namespace angen::load
