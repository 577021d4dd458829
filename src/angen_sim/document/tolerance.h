#pragma once

#include <optional>

#include "core/element.h"

/// Whether a document of others may have what Angen does not know.
namespace angen::load {

/// The attribute of a <world>, <model>, <include> or <actor> that overrides the rule: "true" or
/// "false". A world that is written has kGuessed where it was tolerant by what it held.
constexpr char kStrict[] = "angen:strict";
constexpr char kGuessed[] = "guessed";

/// What an element's kStrict says: false for kGuessed, none where it has none. Throws Error for
/// another word.
std::optional<bool> marked_strict(const Element& element);
bool marked_guessed(const Element& element);

/// Whether a <plugin> below `element` is a kind of Angen's: its library is given by a path, or has
/// a catalog file on the plug-in path and is none that robots made for Gazebo name.
bool holds_own_plugin(const Element& element);

}  // namespace angen::load
