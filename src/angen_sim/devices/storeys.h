#pragma once

#include <string>

/// The layout of Angen's buildings: storeys of one height, and their parts named after the
/// room and storey.
namespace angen::devices {

/// Height between two floors in meters; floor 0 is at z = 0.
constexpr double kStoreyHeight = 4.0;

/// floor((z + 0.5) / 4): the storey of a model whose origin is at z meters.
int floor_of(double z);

/// The name that commands use: the model's without trailing digits and '_' and without the kind as
/// suffix or prefix (`_door`, `door_`), followed by the floor. command_name("bathroom_door1",
/// "door", 4.0) is "bathroom1", and so is that of "bath_door1".
std::string command_name(const std::string& model, const std::string& kind, double z);

/// The name of a part of a model that has the kind in its name; all from there on is left out, and
/// `_fN` before it is the floor. leaf_name("entrance_f1_door_block", "door", 0.0) is "entrance1".
/// Empty for a part of another name.
std::string leaf_name(const std::string& part, const std::string& kind, double z);

}  // namespace angen::devices
