#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "core/text.h"
#include "home/solids.h"
#include "home/survey.h"

namespace angen {

namespace {

constexpr double kSample = 0.1;      // m between the points at which rooms are compared
constexpr double kHalfWall = 0.06;   // m: edges may be in the middle of a wall
constexpr double kOverlap = 0.2;     // m^2 that two rooms may have in common
constexpr double kInto = 0.03;       // m that a thing may be in a wall
constexpr double kOverFloor = 0.05;  // m: things on a floor touch it

std::string quoted(const std::string& name) { return "'" + printable(name) + "'"; }

std::string meters(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

class Checks {
 public:
  Checks(const HomeSurvey& survey, const Home& home) : survey_(survey), home_(home) {}

  std::vector<HomeFinding> all() {
    list_guesses();
    check_names();
    compare_rooms();
    check_storeys();
    check_doors();
    check_entrance();
    check_reach();
    check_things();
    return std::move(found_);
  }

 private:
  void guess(std::string text) { found_.push_back({true, std::move(text)}); }
  void contradict(std::string text) { found_.push_back({false, std::move(text)}); }

  void list_guesses() {
    std::string names;
    for (const Room& room : home_.rooms) {
      if (room.guessed) names += (names.empty() ? "" : ", ") + room.name;
    }
    if (!names.empty()) {
      guess("the world names no rooms; found between walls: " + names +
            "; describe them by <angen:room>");
    }
    if (home_.rooms.empty()) guess("there are no rooms: no walls enclose one");
    if (survey_.site.entrance.empty() && !home_.entrance.empty()) {
      guess("no main entrance is given; " + quoted(home_.entrance) +
            " leads outside; name it in <angen:entrance>");
    } else if (home_.entrance.empty() && !home_.rooms.empty()) {
      guess("no main entrance is given, and no door leads outside; name it in <angen:entrance>");
    }
    if (!survey_.site.north) guess("no <angen:north> is given; +y is taken as north");
    if (!survey_.site.latitude) guess("no <angen:latitude> is given");
    if (survey_.site.start.empty())
      guess("no <angen:start> is given, the time at simulated time 0");
  }

  void check_names() {
    std::map<std::string, int> count;
    const auto add = [&](const std::string& what, const std::string& name) {
      if (++count[what + name] != 2) return;
      contradict("two " + what + " are named " + quoted(name) + "; give each its own name");
    };
    for (const Room& room : home_.rooms) add("rooms", room.name);
    for (const Storey& storey : home_.storeys) add("storeys", storey.name);
    for (const HomeDoor& door : home_.doors) {
      if (door.kind != HomeDoor::Kind::kWindow) add("doors or openings", door.name);
    }
  }

  void compare_rooms() {
    for (std::size_t i = 0; i < home_.rooms.size(); ++i) {
      for (std::size_t j = i + 1; j < home_.rooms.size(); ++j) {
        const double area = common_area(home_.rooms[i], home_.rooms[j]);
        if (area < kOverlap) continue;
        contradict("rooms " + quoted(home_.rooms[i].name) + " and " + quoted(home_.rooms[j].name) +
                   " overlap by " + meters(area) + " m^2; draw the line between them");
      }
    }
  }

  static double common_area(const Room& a, const Room& b) {
    if (std::min(a.ceiling, b.ceiling) - std::max(a.floor, b.floor) < 0.5) return 0.0;
    Eigen::AlignedBox2d box_a;
    Eigen::AlignedBox2d box_b;
    for (const Point2& corner : a.outline) box_a.extend(corner);
    for (const Point2& corner : b.outline) box_b.extend(corner);
    const Eigen::AlignedBox2d both = box_a.intersection(box_b);
    if (both.isEmpty()) return 0.0;
    const double step = std::max(kSample, both.sizes().maxCoeff() / 300.0);
    double area = 0.0;
    for (double y = both.min().y() + step / 2; y < both.max().y(); y += step) {
      for (double x = both.min().x() + step / 2; x < both.max().x(); x += step) {
        const Point2 point(x, y);
        const bool inside = a.contains(point) && b.contains(point) &&
                            a.distance(point) > kHalfWall && b.distance(point) > kHalfWall;
        if (inside) area += step * step;
      }
    }
    return area;
  }

  void check_storeys() {
    for (std::size_t i = 1; i < home_.storeys.size(); ++i) {
      const Storey& below = home_.storeys[i - 1];
      const Storey& above = home_.storeys[i];
      if (below.number < above.number) continue;
      contradict("storey " + std::to_string(above.number) + " at " + meters(above.elevation) +
                 " m is over storey " + std::to_string(below.number) + " at " +
                 meters(below.elevation) + " m; number them from the lowest up");
    }
  }

  void check_doors() {
    for (const HomeDoor& door : home_.doors) {
      if (door.rooms[0] != door.rooms[1] || home_.rooms.empty()) continue;
      const std::string where = " at " + meters(door.pose.position.x()) + " " +
                                meters(door.pose.position.y()) + " " +
                                meters(door.pose.position.z());
      const std::string sides = door.rooms[0].empty()
                                    ? "no room on either side"
                                    : "room " + quoted(door.rooms[0]) + " on both sides";
      contradict(std::string(name_of(door.kind)) + " " + quoted(door.name) + where +
                 " joins nothing: it has " + sides);
    }
    for (const HomeElevator& elevator : home_.elevators) {
      for (const Landing& landing : elevator.landings) {
        if (!landing.room.empty() || home_.rooms.empty()) continue;
        contradict("elevator " + quoted(elevator.name) + " has no room before it on storey " +
                   std::to_string(landing.storey));
      }
    }
  }

  void check_entrance() {
    if (survey_.site.entrance.empty()) return;
    for (const HomeDoor& door : home_.doors) {
      if (door.name == home_.entrance && door.kind != HomeDoor::Kind::kWindow) return;
    }
    contradict("the main entrance " + quoted(home_.entrance) + " is no door or opening");
  }

  // From the outside, and from both sides of the main entrance.
  void check_reach() {
    std::map<std::string, std::set<std::string>> next;
    for (const HomeDoor& door : home_.doors) {
      if (door.kind == HomeDoor::Kind::kWindow) continue;
      next[door.rooms[0]].insert(door.rooms[1]);
      next[door.rooms[1]].insert(door.rooms[0]);
      if (door.name == home_.entrance) next[""].insert({door.rooms[0], door.rooms[1]});
    }
    for (const HomeElevator& elevator : home_.elevators) {
      for (const Landing& landing : elevator.landings) {
        if (landing.room.empty()) continue;
        next["\n" + elevator.name].insert(landing.room);
        next[landing.room].insert("\n" + elevator.name);
      }
    }
    if (next[""].empty() && !home_.rooms.empty()) next[""].insert(home_.rooms.front().name);
    std::set<std::string> reached = {""};
    std::vector<std::string> left = {""};
    while (!left.empty()) {
      const std::string here = left.back();
      left.pop_back();
      for (const std::string& there : next[here]) {
        if (reached.insert(there).second) left.push_back(there);
      }
    }
    for (const Room& room : home_.rooms) {
      if (reached.count(room.name) != 0) continue;
      contradict("no person can reach room " + quoted(room.name) +
                 ": no door, <angen:opening> or elevator leads there");
    }
  }

  void check_things() {
    if (home_.rooms.empty()) return;
    std::vector<std::pair<const desc::Model*, OrientedBox>> walls;
    for (const HomeSurvey::Standing& standing : survey_.models) {
      if (!standing.model->is_static || !standing.model->home.thing.empty()) continue;
      const bool is_building = !standing.model->home.rooms.empty() || home_.rooms[0].guessed ||
                               home_.rooms[0].model.empty();
      if (!is_building) continue;
      for (const OrientedBox& box : solid_boxes(standing)) {
        walls.emplace_back(standing.model.get(), box);
      }
    }
    for (const HomeSurvey::Standing& standing : survey_.models) {
      const desc::HomeParts& parts = standing.model->home;
      if (parts.thing.empty() || parts.thing == "window") continue;
      check_thing(standing, walls);
    }
    for (const Thing& thing : home_.things) {
      const std::string what = thing.type + " " + quoted(thing.name);
      if (thing.room.empty()) contradict(what + " is in no room");
      for (const Place& place : thing.places) {
        const Vec3 above = place.pose.position + Vec3::UnitZ() * kSample;
        if (thing.room.empty() || home_.room_at(above) != nullptr) continue;
        contradict(what + ": where one would " + place.posture + ", at " +
                   meters(place.pose.position.x()) + " " + meters(place.pose.position.y()) +
                   ", is in no room");
      }
    }
  }

  void check_thing(const HomeSurvey::Standing& standing,
                   const std::vector<std::pair<const desc::Model*, OrientedBox>>& walls) {
    for (OrientedBox box : solid_boxes(standing)) {
      // Its feet may be a little in the floor.
      box.pose.position.z() += kOverFloor / 2;
      box.size.z() -= kOverFloor;
      if (box.size.minCoeff() <= 0.0) continue;
      for (const auto& [model, wall] : walls) {
        const double into = overlap_of(box, wall);
        if (into < kInto) continue;
        contradict(standing.model->home.thing + " " + quoted(standing.model->name) + " is " +
                   meters(into) + " m in a wall or floor of " + quoted(model->name) + ", at " +
                   meters(box.pose.position.x()) + " " + meters(box.pose.position.y()));
        return;
      }
    }
  }

  const HomeSurvey& survey_;
  const Home& home_;
  std::vector<HomeFinding> found_;
};

}  // namespace

std::vector<HomeFinding> check_home(const HomeSurvey& survey, const Home& home) {
  return Checks(survey, home).all();
}

}  // namespace angen
