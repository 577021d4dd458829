#pragma once

#include <optional>

#include "core/element.h"

/// Whether a document of others may have what Angen does not know.
namespace angen::load {

/// The attribute of a <world>, <model>, <include> or <actor> that overrides the rule: "true" or
/// "false".
constexpr char kStrict[] = "angen:strict";

/// What an element's kStrict says; none where it has none. Throws Error for another word.
std::optional<bool> marked_strict(const Element& element);

/// Whether a <plugin> below `element` is a kind of Angen's: its library is given by a path, or has
/// a catalog file on the plug-in path and is none that robots made for Gazebo name,
/// libgazebo_ros_….so.
bool holds_own_plugin(const Element& element);

}  // namespace angen::load
