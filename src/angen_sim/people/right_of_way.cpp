#include "people/right_of_way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "people/door_use.h"
#include "people/modes.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

using Vec2 = Surroundings::Vec2;

constexpr double kTwoAbreast = 0.6;   // m that the middles of two need beside each other
constexpr double kOneStretch = 0.5;   // m between narrow places that are one passage
constexpr double kYieldsAt = 1.7;     // m before a passage, where one looks who is in it
constexpr double kClaims = 2.6;       // m: who is nearer than this wants to go in
constexpr double kInsideEnds = 0.35;  // m beyond both ends that belong to a passage
constexpr double kInsideWide = 0.45;  // m from its line
constexpr double kWalkSpeed = 0.1;    // m/s: who is slower stands
constexpr double kFaces = 0.3;        // cosine, of who wants to go in
constexpr double kPersonApart = 0.6;  // m between the middles of two who wait
constexpr double kAlike = 0.5;        // m: distances that count as the same
constexpr double kAtDoorway = 0.7;    // m from a passage to a door that is in it
constexpr std::array<double, 4> kBefore{0.6, 1.2, 1.8, 2.4};      // m before the passage …
constexpr std::array<double, 4> kBeside{0.85, -0.85, 1.5, -1.5};  // … and beside its line: to wait

struct Other {
  Vec2 at;
  Vec2 heading;
  bool walks;
  bool has_arrived;
};

std::vector<Other> others_near(const View& view, const Vec3& feet) {
  std::vector<Other> others;
  for (const DeviceView& person : Surroundings::other_people(view, feet)) {
    const double yaw = person.state.get<double>("yaw");
    const auto& mode = person.state.get<std::string>("mode");
    others.push_back({{person.state.get<double>("x"), person.state.get<double>("y")},
                      {std::cos(yaw), std::sin(yaw)},
                      person.state.get<double>("speed") > kWalkSpeed,
                      mode != kModes[1] && mode != kModes[2]});
  }
  return others;
}

/// A passage as one sees it who is about to go in.
struct Line {
  explicit Line(const Passage& passage)
      : from(passage.enter),
        length(std::max(0.0, passage.along.dot(passage.leave - passage.enter))),
        along(passage.along),
        side(-along.y(), along.x()) {}
  double ahead(const Vec2& at) const { return along.dot(at - from); }
  bool holds(const Vec2& at) const {
    return ahead(at) > -kInsideEnds && ahead(at) < length + kInsideEnds &&
           std::abs(side.dot(at - from)) < kInsideWide;
  }

  Vec2 middle() const { return from + 0.5 * length * along; }

  Vec2 from;
  double length;
  Vec2 along;
  Vec2 side;
};

/// m to the middle of the passage of one who wants to go in; none of another.
std::optional<double> claim(const Line& line, const Other& other) {
  const Vec2 way = line.middle() - other.at;
  const double away = way.norm();
  if (other.has_arrived || away > kClaims || way.dot(other.heading) < kFaces * away)
    return std::nullopt;
  return away;
}

/// Who has the lowest goes first: one order for all, though each measures a bit differently.
std::tuple<int, double, double> turn_of(double away, const Vec2& at) {
  return {static_cast<int>(away / kAlike), at.x(), at.y()};
}

bool may_go(const Line& line, const Vec2& at, const std::vector<Other>& others) {
  const double own = (line.middle() - at).norm();
  for (const Other& other : others) {
    if (line.holds(other.at)) {
      if (!other.walks || other.heading.dot(line.along) < 0.0) return false;
      continue;
    }
    const std::optional<double> away = claim(line, other);
    if (!away) continue;
    if (turn_of(*away, other.at) < turn_of(own, at)) return false;
  }
  return true;
}

bool has_shut_door(const View& view, const Line& line, double z) {
  const std::vector<DoorSeen> doors = doors_seen(view, z);
  return std::any_of(doors.begin(), doors.end(), [&](const DoorSeen& door) {
    const Vec2 leaf = door.hinge + 0.5 * door.width * door.along;
    return !door.is_passable() && (leaf - line.middle()).norm() < kAtDoorway + 0.5 * line.length;
  });
}

/// The nearest free place beside the way; where it is if there is none.
Vec2 place_beside(const View& view, const Vec3& feet, const Line& line,
                  const std::vector<Other>& others) {
  const Vec2 at = feet.head<2>();
  std::vector<Vec2> places;
  for (const double before : kBefore) {
    for (const double beside : kBeside) {
      places.push_back(line.from - before * line.along + beside * line.side);
    }
  }
  std::stable_sort(places.begin(), places.end(), [&](const Vec2& a, const Vec2& b) {
    return (a - at).squaredNorm() < (b - at).squaredNorm();
  });
  for (const Vec2& place : places) {
    const bool taken = std::any_of(others.begin(), others.end(), [&](const Other& other) {
      return (other.at - place).norm() < kPersonApart;
    });
    if (taken) continue;
    const FloorMap map(view, feet, place, FloorMap::Extent::kStraight);
    if (map.is_clear(at, place) && map.has_floor(view, at, place)) return place;
  }
  return at;
}

}  // namespace

std::vector<Passage> passages_of(const FloorMap& map, const std::vector<Vec2>& way) {
  const auto free_beside = [&](const Vec2& at, const Vec2& side) {
    double width = 0.0;
    while (width < kTwoAbreast && map.is_free(at + (width + FloorMap::kCell) * side)) {
      width += FloorMap::kCell;
    }
    return width;
  };
  std::vector<Passage> passages;
  for (std::size_t i = 1; i + 1 < way.size(); ++i) {
    const Vec2 ahead = way[std::min(i + 2, way.size() - 1)] - way[i - std::min<std::size_t>(i, 2)];
    if (ahead.norm() < 1e-6) continue;
    const Vec2 side = Vec2(-ahead.y(), ahead.x()).normalized();
    const double left = free_beside(way[i], side);
    const double right = free_beside(way[i], -side);
    if (left + right >= kTwoAbreast) continue;
    const Vec2 middle = way[i] + 0.5 * (left - right) * side;
    if (!passages.empty() && (middle - passages.back().leave).norm() < kOneStretch) {
      passages.back().leave = middle;
    } else {
      passages.push_back({middle, middle, ahead.normalized()});
    }
  }
  return passages;
}

bool have_others_to_go(const View& view, const Vec3& feet) {
  const std::vector<Other> others = others_near(view, feet);
  return std::any_of(others.begin(), others.end(), [&](const Other& other) {
    return !other.has_arrived && (other.at - feet.head<2>()).norm() < Surroundings::kSight;
  });
}

std::optional<Vec2> place_to_wait(const View& view, const Vec3& feet,
                                  const std::vector<Passage>& passages,
                                  const std::optional<Vec2>& beside) {
  const std::vector<Other> others = others_near(view, feet);
  if (others.empty()) return std::nullopt;
  const Vec2 at = feet.head<2>();
  const bool is_inside = std::any_of(passages.begin(), passages.end(), [&](const Passage& passage) {
    return Line(passage).holds(at);
  });
  if (is_inside) return std::nullopt;
  for (const Passage& passage : passages) {
    const Line line(passage);
    if (line.ahead(at) > 0.5 * line.length) continue;  // it is past it
    if ((line.from - at).norm() > (beside ? kClaims + 1.0 : kYieldsAt)) continue;
    if (has_shut_door(view, line, feet.z()) || may_go(line, at, others)) continue;
    return beside ? *beside : place_beside(view, feet, line, others);
  }
  return std::nullopt;
}

}  // namespace angen::people
