#include "people/places.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

#include "core/text.h"
#include "people/floor_map.h"
#include "people/ride.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

using Vec2 = Surroundings::Vec2;

constexpr double kGrounds = 20.0;  // m around all rooms, where people go
constexpr double kRoomStep = 0.1;  // m between places of a room that are tried
constexpr double kOpenRoom = 1.0;  // m from walls: farther away is no better
constexpr double kUseReach = 1.1;  // m from a person to the thing that it uses
constexpr std::size_t kNamed = 8;  // names that an error lists

Found none(std::string why) { return {{}, std::move(why)}; }

template <typename T>
const T* named(const std::vector<T>& all, const std::string& name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const T& each) { return is_same(each.name, name); });
  return found == all.end() ? nullptr : &*found;
}

// Why a place is none to go to; empty if it is one.
std::string outside(const Vec2& place, const Home& home) {
  Eigen::AlignedBox2d grounds;
  for (const Room& room : home.rooms) {
    for (const Point2& corner : room.outline) grounds.extend(corner);
  }
  if (grounds.isEmpty()) return "";
  const Point2 low = grounds.min().array() - kGrounds;
  const Point2 high = grounds.max().array() + kGrounds;
  if (Eigen::AlignedBox2d(low, high).contains(place)) return "";
  return text_of(place.x(), " ", place.y(), " is outside of the world; x is ", std::round(low.x()),
                 " to ", std::round(high.x()), ", y ", std::round(low.y()), " to ",
                 std::round(high.y()), " m");
}

// In the open, away from walls.
Found in_room(const Room& room, const View& view) {
  Eigen::AlignedBox2d box;
  for (const Point2& corner : room.outline) box.extend(corner);
  const auto place = best_place(view, box, room.floor, [&](const Vec2& at) {
    return room.contains(at) ? std::min(room.distance(at), kOpenRoom) : 0.0;
  });
  if (!place) return none("there is no place to stand in " + room.name);
  return {{*place, room.storey}, ""};
}

// Within reach of the thing, or of where one uses it.
Found at_thing(const Thing& thing, const View& view) {
  const Vec3 at = thing.places.empty() ? thing.pose.position : thing.places[0].pose.position;
  const Storey* storey = storey_at(view.home().storeys, at.z());
  const double floor = storey != nullptr ? storey->elevation : at.z();
  const Vec2 middle = at.head<2>();
  const Vec2 reach = Vec2::Constant(kUseReach);
  const Room* room = named(view.home().rooms, thing.room);
  const auto place = best_place(view, {middle - reach, middle + reach}, floor, [&](const Vec2& p) {
    return room == nullptr || room->contains(p) ? kUseReach - (p - middle).norm() : 0.0;
  });
  if (!place) return none("there is no place to stand at " + thing.name);
  return {{*place, storey != nullptr ? std::optional(storey->number) : std::nullopt}, ""};
}

Found by_name(const std::string& name, const View& view) {
  const Home& home = view.home();
  if (const Room* room = named(home.rooms, name)) return in_room(*room, view);
  if (const Thing* thing = named(home.things, name)) return at_thing(*thing, view);
  std::string rooms;
  for (std::size_t i = 0; i < std::min(kNamed, home.rooms.size()); ++i) {
    rooms += (i == 0 ? "" : ", ") + home.rooms[i].name;
  }
  if (home.rooms.size() > kNamed) rooms += ", …";
  return none("no room or thing is named '" + printable(name) + "'" +
              (rooms.empty() ? "; this world describes no rooms" : "; rooms are " + rooms));
}

}  // namespace

bool is_same(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

std::optional<Surroundings::Vec2> best_place(const View& view, const Eigen::AlignedBox2d& box,
                                             double floor,
                                             const std::function<double(const Vec2&)>& rate) {
  const Vec3 corner(box.min().x(), box.min().y(), floor);
  const FloorMap map(view, corner, box.max(), FloorMap::Extent::kStraight);
  std::optional<Surroundings::Vec2> best;
  double most = 0.0;
  for (double y = box.min().y(); y <= box.max().y(); y += kRoomStep) {
    for (double x = box.min().x(); x <= box.max().x(); x += kRoomStep) {
      const Vec2 at(x, y);
      const double rating = rate(at);
      if (rating <= most || !map.is_free(at) || !map.has_floor(view, at, at)) continue;
      most = rating;
      best = at;
    }
  }
  return best;
}

std::string unserved(int floor, const Home& home, const Vec3& feet) {
  const auto is_it = [&](const Storey& storey) { return storey.number == floor; };
  if (std::none_of(home.storeys.begin(), home.storeys.end(), is_it)) {
    std::vector<std::string> floors;
    for (const Storey& storey : home.storeys) floors.push_back(std::to_string(storey.number));
    return "there is no floor " + std::to_string(floor) +
           (floors.empty() ? "; this world describes none" : "; floors are " + join_names(floors));
  }
  const int here = floor_at(home.storeys, feet.z());
  if (here == floor || Ride::between(home, here, floor, {})) return "";
  return "no elevator goes from floor " + std::to_string(here) + " to floor " +
         std::to_string(floor);
}

Found find_goal(const Command& command, const View& view, const Vec3& feet) {
  Found found;
  if (!command.place.empty()) {
    found = by_name(command.place, view);
  } else {
    found.goal.to = {command.values.at(0), command.values.at(1)};
    if (command.values.size() > 2) {
      const double floor = command.values[2];
      if (floor != std::round(floor) || std::abs(floor) > 1e6) {
        return none(number_text(floor) + " is not the number of a floor");
      }
      found.goal.floor = static_cast<int>(floor);
    }
    found.why_not = outside(found.goal.to, view.home());
  }
  if (found.why_not.empty() && found.goal.floor) {
    found.why_not = unserved(*found.goal.floor, view.home(), feet);
  }
  return found;
}

}  // namespace angen::people
