#pragma once

#include <string>

#include "sim/snapshot.h"

/// The groups of links, which viewers switch off together; they have the storeys and sides of a
/// building.
namespace angen::scene {

/// The group of a link: `doors 0`, `walls south 1`, `furniture 0`, `robots`, … with the storey that
/// its description places the model on.
std::string group_of(const sim::Structure& structure, std::uint32_t link);

/// A static model of many links is a building: its links are distinguished by their names.
bool is_building(const desc::Model& model);

/// " 0" at a height on storey 0; empty for models that change storeys: people, robots and
/// elevators.
std::string storey_suffix(const sim::Structure& structure, std::uint32_t model, double z);

/// "south" for a link that is a part of the building's outermost wall at its lowest y, likewise
/// west, north and east; empty for all others.
std::string outer_side(const desc::Model& building, const desc::Link& link);

/// The same of a model in the wall of the building around it, such as a window.
std::string outer_side(const sim::Structure& structure, const desc::Model& window);

/// The same of a surface within that box (world).
std::string outer_side(const sim::Structure& structure, const Eigen::AlignedBox3d& surface);

}  // namespace angen::scene
