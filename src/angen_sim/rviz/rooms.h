#pragma once

#include <string>
#include <vector>

#include "sim/snapshot.h"

/// The storeys, sides and rooms of a building, for markers.
namespace angen::node {

/// The space over one floor link of a building.
struct Room {
  std::string building;  // its model's name
  std::string name;      // the floor link's without "floor": "kitchen"
  std::string storey;    // as storey_suffix
  Pose pose;             // of the middle of its floor, in the world
  Vec3 size;             // m, between its walls and up to its ceiling
};

/// A static model of many links is a building: its links are distinguished by their names.
bool is_building(const desc::Model& model);

/// " 0" for what its description places on floor 0; empty for models that change storeys: people,
/// robots and elevators.
std::string storey_suffix(const sim::Structure& structure, std::uint32_t model, double z);

/// "south" for a link that is a part of the building's outermost wall at its lowest y, likewise
/// west, north and east; empty for all others.
std::string outer_side(const desc::Model& building, const desc::Link& link);

/// Rooms of all buildings. A floor link that is not a box, or smaller than a square meter, has
/// none.
std::vector<Room> find_rooms(const sim::Structure& structure);

/// The room that a point in the world is in, or null.
const Room* room_around(const std::vector<Room>& rooms, const Vec3& point);

}  // namespace angen::node
