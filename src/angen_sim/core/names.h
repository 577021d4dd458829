#pragma once

#include <string>

namespace angen {

/// Height between two floors in metres; floor 0 stands at z = 0.
constexpr double kStoreyHeight = 4.0;

/// floor((z + 0.5) / 4): the storey a model belongs to by its origin's z in metres.
int floor_of(double z);

/// The name that commands use: trailing digits and '_' off, the kind's own suffix or prefix off
/// (`_door`, `door_`), the floor on. command_name("bathroom_door1", "door", 4.0) is "bathroom1".
std::string command_name(const std::string& model, const std::string& kind, double z);

}  // namespace angen
