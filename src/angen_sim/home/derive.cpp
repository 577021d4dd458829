#include "home/derive.h"

#include <algorithm>
#include <cmath>

namespace angen {

namespace {

constexpr double kAbove = 0.1;  // m over its origin, a thing is in its room
constexpr double kAhead = 0.3;  // m: a thing on a wall faces its room

Polygon placed(const Polygon& polygon, const Pose& frame) {
  Polygon all;
  for (const Point2& point : polygon) {
    all.push_back((frame * Vec3(point.x(), point.y(), 0.0)).head<2>());
  }
  return all;
}

double area_of(const Room& room) {
  double area = std::abs(signed_area(room.outline));
  for (const Polygon& hole : room.holes) area -= std::abs(signed_area(hole));
  return area;
}

void add_heights(const std::vector<Room>& rooms, std::vector<Storey>& storeys) {
  for (std::size_t i = 0; i < storeys.size(); ++i) {
    Storey& storey = storeys[i];
    if (storey.name.empty()) storey.name = "Floor " + std::to_string(storey.number);
    if (storey.height > 0.0) continue;
    double top = storey.elevation;
    for (const Room& room : rooms) top = std::max(top, room.ceiling);
    storey.height = (i + 1 < storeys.size() ? storeys[i + 1].elevation : top) - storey.elevation;
  }
}

void add_rooms_and_storeys(const HomeSurvey& survey, Home& home) {
  home.rooms = rooms_of(survey.parts, Pose{}, "");
  for (const HomeSurvey::Standing& standing : survey.models) {
    const desc::Model& model = *standing.model;
    for (Room& room : rooms_of(model.home, standing.pose, model.name)) {
      home.rooms.push_back(std::move(room));
    }
  }
  home.storeys = survey.storeys;
  const bool guessed = home.rooms.empty();
  if (guessed) home.rooms = guess_rooms(survey);
  add_heights(home.rooms, home.storeys);
  for (std::size_t i = 0; i < home.rooms.size(); ++i) {
    Room& room = home.rooms[i];
    room.guessed = guessed;
    room.storey = storey_at(home.storeys, room.floor)->number;
    room.name =
        guessed ? "room" + std::to_string(i) : with_storey(room.name, std::to_string(room.storey));
    if (signed_area(room.outline) < 0.0) std::reverse(room.outline.begin(), room.outline.end());
    room.area = area_of(room);
  }
}

void add_thing(const HomeSurvey::Standing& standing, Home& home) {
  const desc::HomeParts& parts = standing.model->home;
  if (parts.thing.empty()) return;
  Thing thing;
  thing.name = standing.model->name;
  thing.type = parts.thing;
  thing.pose = standing.pose;
  const Vec3 above = Vec3::UnitZ() * kAbove;
  thing.room = home.room_name_at(standing.pose.position + above);
  if (thing.room.empty()) thing.room = home.room_name_at(standing.pose * Vec3(kAhead, 0.0, kAbove));
  const double yaw = yaw_of(standing.pose.rotation);
  for (Place place : parts.places) {
    place.pose.position = standing.pose * place.pose.position;
    place.pose.yaw = std::remainder(place.pose.yaw + yaw, 2 * M_PI);
    thing.places.push_back(std::move(place));
  }
  home.things.push_back(std::move(thing));
}

// The first door that leads out of the lowest storey.
std::string likely_entrance(const Home& home) {
  if (home.storeys.empty()) return "";
  for (const HomeDoor& door : home.doors) {
    if (door.kind == HomeDoor::Kind::kWindow || door.rooms[0] == door.rooms[1]) continue;
    if (!door.rooms[0].empty() && !door.rooms[1].empty()) continue;
    if (storey_at(home.storeys, door.pose.position.z()) == &home.storeys.front()) return door.name;
  }
  return "";
}

}  // namespace

std::vector<Room> rooms_of(const desc::HomeParts& parts, const Pose& frame,
                           const std::string& model) {
  std::vector<Room> rooms;
  for (const desc::Room& given : parts.rooms) {
    Room room;
    room.name = given.name;
    room.use = given.use;
    room.outline = placed(given.outline, frame);
    for (const Polygon& hole : given.holes) room.holes.push_back(placed(hole, frame));
    const Point2& corner = given.outline.front();
    room.floor = (frame * Vec3(corner.x(), corner.y(), given.floor)).z();
    room.ceiling = room.floor + given.ceiling;
    room.area = area_of(room);
    room.model = model;
    room.number = rooms.size();
    rooms.push_back(std::move(room));
  }
  return rooms;
}

Home derive_home(const HomeSurvey& survey) {
  Home home;
  home.north = survey.site.north.value_or(home.north);
  home.latitude = survey.site.latitude.value_or(home.latitude);
  home.start = survey.site.start;
  add_rooms_and_storeys(survey, home);
  for (const HomeSurvey::Standing& standing : survey.models) add_thing(standing, home);
  add_passages(survey, home);
  home.list_doors();
  home.entrance = survey.site.entrance.empty() ? likely_entrance(home) : survey.site.entrance;
  return home;
}

const Home& DerivedHome::get() const {
  std::call_once(once_, [this] { home_ = derive_home(survey_); });
  return home_;
}

}  // namespace angen
