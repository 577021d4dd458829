#pragma once

#include <string>

#include "sdf/load.h"

/// Writes changes since a text was read into its elements.
namespace angen::load {

/// The <link> or <joint> of a written-out model, null if it has none; "child::link" is in the
/// nested model `child`.
Element* find_part(Element& model, const std::string& element, const std::string& name);

/// Inertials, gravity and lights of links, and damping and limits of joints, where `now` differs
/// from `read`.
void write_changes(const desc::Model& read, const desc::Model& now, Element& model);

/// Parameters of a light's own lamp, into that light of an element.
void write_lamp(const LightState& light, Element& holder);

/// The world's own lights as they are now: changed ones, without those that were deleted, and
/// with those that were spawned.
void write_lights(const desc::World& read, const std::vector<LightState>& now, Element& world);

/// Gravity and physics, where they differ from the world's.
void write_settings(const desc::World& read, const WorldState& now, Element& world);

}  // namespace angen::load
