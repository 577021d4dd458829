#include "core/home.h"

#include <algorithm>
#include <numeric>

#include "core/text.h"

namespace angen {

namespace {

constexpr double kInWall = 0.1;   // m: a thing in a wall, floor or ceiling is in the room
constexpr double kOnFloor = 0.5;  // m below its floor that belong to a storey

}  // namespace

const char* name_of(HomeDoor::Kind kind) {
  switch (kind) {
    case HomeDoor::Kind::kDoor:
      return "door";
    case HomeDoor::Kind::kWindow:
      return "window";
    case HomeDoor::Kind::kOpening:
      return "opening";
  }
  return "";
}

bool Room::contains(const Point2& point) const {
  return angen::contains(outline, point) &&
         std::none_of(holes.begin(), holes.end(),
                      [&](const Polygon& hole) { return angen::contains(hole, point); });
}

double Room::distance(const Point2& point) const {
  double nearest = distance_to_edge(outline, point);
  for (const Polygon& hole : holes) nearest = std::min(nearest, distance_to_edge(hole, point));
  return nearest;
}

bool Room::at_height(double z) const { return z >= floor - kInWall && z <= ceiling + kInWall; }

void Home::list_doors() {
  doors_by_name.resize(doors.size());
  std::iota(doors_by_name.begin(), doors_by_name.end(), std::size_t{0});
  std::stable_sort(doors_by_name.begin(), doors_by_name.end(),
                   [&](std::size_t a, std::size_t b) { return doors[a].name < doors[b].name; });
}

const HomeDoor* Home::door(HomeDoor::Kind kind, std::string_view name) const {
  const auto first = std::lower_bound(doors_by_name.begin(), doors_by_name.end(), name,
                                      [&](std::size_t number, std::string_view wanted) {
                                        return std::string_view(doors[number].name) < wanted;
                                      });
  for (auto at = first; at != doors_by_name.end() && doors[*at].name == name; ++at) {
    if (doors[*at].kind == kind) return &doors[*at];
  }
  return nullptr;
}

const Room* Home::room_at(const Vec3& point) const {
  const Point2 flat = point.head<2>();
  for (const Room& room : rooms) {
    if (room.at_height(point.z()) && room.contains(flat)) return &room;
  }
  const Room* nearest = nullptr;
  double distance = kInWall;
  for (const Room& room : rooms) {
    if (!room.at_height(point.z())) continue;
    const double away = room.distance(flat);
    if (away >= distance) continue;
    distance = away;
    nearest = &room;
  }
  return nearest;
}

std::string Home::room_name_at(const Vec3& point) const {
  const Room* room = room_at(point);
  return room == nullptr ? "" : room->name;
}

const Storey* storey_at(const std::vector<Storey>& storeys, double z) {
  const Storey* found = storeys.empty() ? nullptr : &storeys.front();
  for (const Storey& storey : storeys) {
    if (storey.elevation - kOnFloor <= z) found = &storey;
  }
  return found;
}

int floor_at(const std::vector<Storey>& storeys, double z) {
  const Storey* storey = storey_at(storeys, z);
  return storey != nullptr ? storey->number : 0;
}

const std::vector<std::string>& room_uses() {
  static const std::vector<std::string> uses =
      words_in("kitchen bedroom bathroom living hall work landing outdoor other");
  return uses;
}

const std::vector<std::string>& thing_types() {
  static const std::vector<std::string> types = words_in(
      "bed chair armchair sofa table desk stove sink fridge toilet shower bathtub washing_machine "
      "dishwasher tv stereo wardrobe bookshelf cabinet dresser nightstand lamp window plant fan "
      "heater rug stairs other");
  return types;
}

const std::vector<std::string>& postures() {
  static const std::vector<std::string> all = {"stand", "sit", "lie"};
  return all;
}

}  // namespace angen
