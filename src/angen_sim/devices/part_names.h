#pragma once

#include <string>

#include "plugin/plugin.h"

/// The names of a building's parts: after their room and storey.
namespace angen::devices {

/// The name that commands use: the model's without trailing digits and '_' and without the kind as
/// suffix or prefix (`_door`, `door_`), followed by the floor. command_name("bathroom_door1",
/// "door", 1) is "bathroom1", and so is that of "bath_door1".
std::string command_name(const std::string& model, const std::string& kind, int floor);
std::string command_name(const ModelInfo& model, const std::string& kind);

/// The name of a part of a model that has the kind in its name; all from there on is left out, and
/// `_fN` before it is the floor. leaf_name("entrance_f1_door_block", "door", 0) is "entrance1".
/// Empty for a part of another name.
std::string leaf_name(const std::string& part, const std::string& kind, int floor);

}  // namespace angen::devices
