#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/polygon.h"
#include "core/pose.h"

/// The data of a home: its rooms, their contents and connections. Lengths in m, angles in rad, in
/// the world. docs/home.md has the elements of SDF that describe it; module `home` derives it.
namespace angen {

struct Storey {
  int number = 0;
  std::string name;
  double elevation = 0.0;  // the height of its floor
  double height = 0.0;     // to the next storey's floor; of the highest one to its ceiling
};

struct Room {
  std::string name;
  std::string use;  // one of room_uses()
  int storey = 0;   // its number
  Polygon outline;  // counterclockwise
  std::vector<Polygon> holes;
  double floor = 0.0;      // z
  double ceiling = 0.0;    // z
  double area = 0.0;       // m^2, without holes
  bool guessed = false;    // by flood fill: the world names no rooms
  std::string model;       // the model that names it; "" for the world
  std::size_t number = 0;  // among those of its model

  /// Whether a place (x, y) is inside, at any height.
  bool contains(const Point2& point) const;
  /// m to its edge, or to that of a hole.
  double distance(const Point2& point) const;
  bool at_height(double z) const;
};

/// The storey at a height: the highest whose floor is at most 0.5 m above it, or else the lowest;
/// null if there are none.
const Storey* storey_at(const std::vector<Storey>& storeys, double z);
/// Its number; 0 where there are none.
int floor_at(const std::vector<Storey>& storeys, double z);

struct FloorPose {
  Vec3 position = Vec3::Zero();
  double yaw = 0.0;
};

/// The position of a person who stands, sits or lies to use a thing.
struct Place {
  std::string posture;  // stand, sit or lie
  FloorPose pose;       // the feet, the seat, or the middle of a person who lies, head ahead
};

struct Thing {
  std::string name;  // the model's
  std::string type;  // one of thing_types()
  std::string room;  // "" = in none
  Pose pose;
  std::vector<Place> places;
};

struct HomeDoor {
  enum class Kind { kDoor, kWindow, kOpening };
  std::string name;  // the name in commands
  Kind kind = Kind::kDoor;
  std::string rooms[2];  // on the left (+y) and on the right of its pose; "" = outside
  double width = 0.0;
  double height = 0.0;
  FloorPose pose;       // the middle of the opening at its foot, x along the shut leaf
  std::string partner;  // the other leaf of a double door; "" = none
};
const char* name_of(HomeDoor::Kind kind);

struct Landing {
  int storey = 0;
  std::string room;
  FloorPose pose;  // where one waits, facing the cabin
};

struct HomeElevator {
  std::string name;
  Pose pose;  // the cabin's floor, at the lowest stop
  std::vector<Landing> landings;
};

struct Home {
  static constexpr double kNoLatitude = std::numeric_limits<double>::quiet_NaN();

  std::string entrance;
  double north = M_PI_2;          // from +x counterclockwise
  double latitude = kNoLatitude;  // deg
  std::string start;              // local wall-clock time at simulated time 0, "" = not given
  std::vector<Storey> storeys;    // by elevation
  std::vector<Room> rooms;
  std::vector<Thing> things;
  std::vector<HomeDoor> doors;
  std::vector<HomeElevator> elevators;
  std::vector<std::size_t> doors_by_name;  // numbers in `doors`, sorted: see list_doors()

  /// To be called after a change of `doors`.
  void list_doors();
  /// The door, window or opening of that kind and name; null if there is none. Of several, the
  /// first in `doors`.
  const HomeDoor* door(HomeDoor::Kind kind, std::string_view name) const;
  /// The room that a place is in, or in whose wall, floor or ceiling; null outside.
  const Room* room_at(const Vec3& point) const;
  /// Its name, "" outside.
  std::string room_name_at(const Vec3& point) const;
};

/// Words of descriptions.
const std::vector<std::string>& room_uses();
const std::vector<std::string>& thing_types();
const std::vector<std::string>& postures();

}  // namespace angen
