#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/home.h"

/// The parts of a home that a world or a model describes, in its own frame.
namespace angen::desc {

struct Storey {
  std::string name;
  int number = 0;
  double elevation = 0.0;        // m
  std::optional<double> height;  // m
  Source source;
};

struct Room {
  std::string name;  // "{storey}" in it is replaced by the storey's number
  std::string use = "other";
  Polygon outline;
  std::vector<Polygon> holes;
  double floor = 0.0;    // m, z
  double ceiling = 2.5;  // m above its floor
  Source source;
};

/// A passage without a leaf.
struct Opening {
  std::string name;
  FloorPose pose;  // its middle at the floor, x along the wall
  double width = 0.0;
  double height = 0.0;
  Source source;
};

struct HomeParts {
  std::vector<Storey> storeys;
  std::vector<Room> rooms;
  std::vector<Opening> openings;
  std::string thing;  // type of thing of the model, "" = none
  std::vector<Place> places;

  bool empty() const {
    return storeys.empty() && rooms.empty() && openings.empty() && thing.empty() && places.empty();
  }
};

/// The facts about a home that a world has once.
struct HomeSite {
  std::string entrance;
  std::optional<double> north;     // rad
  std::optional<double> latitude;  // deg
  std::string start;
  Source source;
};

}  // namespace angen::desc
