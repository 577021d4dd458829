#include "py/home.h"

#include <pybind11/stl.h>

#include <cmath>
#include <vector>

namespace angen::py {

namespace {

namespace pyb = pybind11;

std::vector<std::vector<double>> corners(const Polygon& polygon) {
  std::vector<std::vector<double>> all;
  for (const Point2& point : polygon) all.push_back({point.x(), point.y()});
  return all;
}

std::vector<double> numbers(const FloorPose& pose) {
  return {pose.position.x(), pose.position.y(), pose.position.z(), pose.yaw};
}

std::vector<double> numbers(const Pose& pose) {
  const Quat& q = pose.rotation;
  return {pose.position.x(), pose.position.y(), pose.position.z(), q.x(), q.y(), q.z(), q.w()};
}

pyb::dict dict_of(const Storey& storey) {
  pyb::dict dict;
  dict["number"] = storey.number;
  dict["name"] = storey.name;
  dict["elevation"] = storey.elevation;
  dict["height"] = storey.height;
  return dict;
}

pyb::dict dict_of(const Room& room) {
  pyb::dict dict;
  dict["name"] = room.name;
  dict["use"] = room.use;
  dict["storey"] = room.storey;
  dict["polygon"] = corners(room.outline);
  std::vector<std::vector<std::vector<double>>> holes;
  for (const Polygon& hole : room.holes) holes.push_back(corners(hole));
  dict["holes"] = holes;
  dict["floor"] = room.floor;
  dict["ceiling"] = room.ceiling;
  dict["area"] = room.area;
  dict["guessed"] = room.guessed;
  return dict;
}

pyb::dict dict_of(const Thing& thing) {
  pyb::list places;
  for (const Place& place : thing.places) {
    pyb::dict dict;
    dict["posture"] = place.posture;
    dict["pose"] = numbers(place.pose);
    places.append(dict);
  }
  pyb::dict dict;
  dict["name"] = thing.name;
  dict["type"] = thing.type;
  dict["room"] = thing.room;
  dict["pose"] = numbers(thing.pose);
  dict["places"] = places;
  return dict;
}

pyb::dict dict_of(const HomeDoor& door) {
  pyb::dict dict;
  dict["name"] = door.name;
  dict["kind"] = name_of(door.kind);
  dict["rooms"] = std::vector<std::string>{door.rooms[0], door.rooms[1]};
  dict["width"] = door.width;
  dict["height"] = door.height;
  dict["pose"] = numbers(door.pose);
  dict["partner"] = door.partner;
  return dict;
}

pyb::dict dict_of(const HomeElevator& elevator) {
  pyb::list landings;
  for (const Landing& landing : elevator.landings) {
    pyb::dict dict;
    dict["storey"] = landing.storey;
    dict["room"] = landing.room;
    dict["pose"] = numbers(landing.pose);
    landings.append(dict);
  }
  pyb::dict dict;
  dict["name"] = elevator.name;
  dict["pose"] = numbers(elevator.pose);
  dict["landings"] = landings;
  return dict;
}

template <class Part>
pyb::list list_of(const std::vector<Part>& parts) {
  pyb::list all;
  for (const Part& part : parts) all.append(dict_of(part));
  return all;
}

}  // namespace

pyb::dict home_dict(const Home& home) {
  pyb::dict dict;
  dict["entrance"] = home.entrance;
  dict["north"] = home.north;
  dict["latitude"] =
      std::isnan(home.latitude) ? pyb::object(pyb::none()) : pyb::float_(home.latitude);
  dict["start"] = home.start;
  dict["storeys"] = list_of(home.storeys);
  dict["rooms"] = list_of(home.rooms);
  dict["things"] = list_of(home.things);
  dict["doors"] = list_of(home.doors);
  dict["elevators"] = list_of(home.elevators);
  return dict;
}

}  // namespace angen::py
