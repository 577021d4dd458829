#pragma once

#include <optional>
#include <string>

#include "core/element.h"

/// Tolerant documents may have elements that Angen does not know.
namespace angen::load {

/// The attribute of a <world>, <model>, <include> or <actor> that overrides the rule: "true" or
/// "false". A saved world has kGuessed if it was tolerant by its contents.
constexpr char kStrict[] = "angen:strict";
constexpr char kGuessed[] = "guessed";

/// The value of an element's kStrict: false for kGuessed, none if it has none. Throws Error for
/// another word.
std::optional<bool> marked_strict(const Element& element);
bool marked_guessed(const Element& element);

/// Whether a library is one that robots made for Gazebo name, by its file name; ours of that name
/// has their parameters.
bool made_for_gazebo(const std::string& library);

/// True if a <plugin> below `element` is a kind of Angen's: its library is given by a path, or has
/// a catalog file on the plug-in path and is none that robots made for Gazebo name.
bool holds_own_plugin(const Element& element);

}  // namespace angen::load
