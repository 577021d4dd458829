#pragma once

#include "desc/world.h"
#include "document/session.h"
#include "sdf/expand.h"
#include "sdf/frames.h"
#include "sdf/geometry.h"
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

/// The colors of a <visual>: its <diffuse> and <emissive>, or those of the Gazebo script it names.
/// A script that is not known is a warning and leaves gray.
desc::Material material_of(const Reader& visual, Session& session);

/// A checked <light>; `pose` is its pose in its link or the world.
desc::Light light_of(const Element& light, const Pose& pose, Session& session);

/// A text that light() reads, as an element of a world of SDF 1.9.
Element light_element(const std::string& what, const std::string& name);

/// The look of a mesh's file, on a visual whose SDF has no material of its own.
void paint(const PlacedShape& mesh, const Source& at, Session& session, desc::Material& material);

}  // namespace angen::load
