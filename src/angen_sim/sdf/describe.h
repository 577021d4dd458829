#pragma once

#include "desc/world.h"
#include "sdf/expand.h"
#include "sdf/frames.h"
#include "sdf/reader.h"

/// Checked trees to descriptions.
namespace angen::load {

/// The element of an <axis> that has the numbers of a URDF's <safety_controller>.
constexpr char kSafety[] = "angen:safety_controller";

/// An expanded, checked <model> element. The pose is left to the caller, and so are the texts for
/// `save`. Nested models become links, joints and plug-ins named `child::name`.
desc::Model describe_model(const Element& model, Session& session);

/// The <inertial> of a link; the unit mass and moment where there is none. An impossible one throws
/// Error, or is a warning and replaced where the link `never_moves`.
desc::Inertial inertial_of(const Reader& link, bool never_moves, Session& session);
/// True if a link that moves may have it.
bool is_possible(const desc::Inertial& inertial);

/// A checked <sensor>; `pose` is its pose in the link.
desc::Sensor sensor_of(const Element& sensor, const Pose& pose, Session& session);

desc::Plugin plugin_of(const Element& plugin);

/// A checked <joint>: `scope` is put before its names; `frames` are the outermost model's.
desc::Joint joint_of(const Element& element, const std::string& scope, Frames& frames,
                     Session& session);

/// Makes one of several hinges that join the same two links about one line, with a warning.
void merge_hinges(desc::Model& model, Session& session);

/// An <actor> as a model that the person plug-in drives. Throws Error.
desc::Model describe_actor(const Element& actor, Session& session);

/// The <physics> that a <world> is stepped by, null if it has none.
const Element* chosen_physics(const Element& world);

/// Physics, gravity and scene out of a checked <world>.
void read_settings(const Element& world, desc::World& to, Session& session);

/// Applies the world's <state>: poses and joint positions. Throws Error for unknown names, unless
/// the dialect permits them.
void apply_state(const Element& state, desc::World& world, Session& session);

}  // namespace angen::load
