#pragma once

#include <string>

#include "core/diagnostics.h"

namespace angen {

/// The rule for the names of models, links, joints, sensors, lights, actors and devices, wherever
/// they come from: 1 to 255 bytes of UTF-8 with no "::" (which joins the names of nested models),
/// no '/' (which separates the parts of a topic), no control characters and no blank at an end;
/// "world" and "__…__" are reserved. Blanks inside are allowed.
constexpr std::size_t kMaxNameBytes = 255;

/// The error in a name, as "the name 'a/b' contains '/'; leave it out"; empty for a valid name.
std::string name_problem(const std::string& name);

/// The rule for labels, which nothing is found by and no topic is made of (the names of worlds
/// and of <plugin>s, where "::" and '/' are common): as for names, with any other characters
/// allowed.
std::string label_problem(const std::string& label);

/// Throws Error at `at` unless the name is valid; `what` names its owner ("<model>").
void check_name(const std::string& name, const std::string& what = "", const Source& at = {});

/// A part's name within its model, of "model::name" or "name".
std::string local_name(const std::string& model, const std::string& name);

}  // namespace angen
