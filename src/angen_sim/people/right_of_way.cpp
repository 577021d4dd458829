#include "people/right_of_way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "people/door_use.h"
#include "people/others.h"
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
constexpr double kBack = 0.6;         // m: a part of the way back out of a passage
const Vec2 kFirst(1.0, 0.618);        // who goes this way rather than back goes on
constexpr std::array<double, 4> kBefore{0.6, 1.2, 1.8, 2.4};      // m before the passage …
constexpr std::array<double, 4> kBeside{0.85, -0.85, 1.5, -1.5};  // … and beside its line: to wait

/// m to the nearer end of the passage, of one who wants to go in; none of another.
std::optional<double> claim(const Passage& passage, const Other& other) {
  const bool before = passage.foot(other.at()).on < 0.5 * passage.length();
  const Vec2 way = (before ? passage.begin() : passage.end()).at - other.at();
  const double away = way.norm();
  if (!other.on_way || away > kClaims || way.dot(other.heading) < kFaces * away)
    return std::nullopt;
  return away;
}

/// Who has the lowest goes first: one order for all, though each measures a bit differently.
std::tuple<int, double, double> turn_of(double away, const Vec2& at) {
  return {static_cast<int>(away / kAlike), at.x(), at.y()};
}

bool may_go_in(const Passage& passage, const Vec2& at, const std::vector<Other>& others) {
  bool follows = false;
  for (const Other& other : others) {
    if (!passage.holds(other.at())) continue;
    const bool comes = other.heading.dot(passage.foot(other.at()).along) < 0.0;
    if (comes || other.speed < kWalkSpeed) return false;
    follows = true;
  }
  const double own = (passage.begin().at - at).norm();
  return follows || std::none_of(others.begin(), others.end(), [&](const Other& other) {
           if (passage.holds(other.at())) return false;
           const std::optional<double> away = claim(passage, other);
           return away && turn_of(*away, other.at()) < turn_of(own, at);
         });
}

/// If people meet in a passage, the fewer leave it again, or if they are as many, one side does.
bool must_leave(const Passage& passage, const Vec2& at, const std::vector<Other>& others) {
  const double own = passage.foot(at).on;
  int with = 1;
  int against = 0;
  for (const Other& other : others) {
    if (!other.on_way || !passage.holds(other.at())) continue;
    const Passage::Foot foot = passage.foot(other.at());
    if (other.heading.dot(foot.along) > 0.0) {
      ++with;
    } else if (foot.on > own) {
      ++against;
    }
  }
  if (against == 0 || with != against) return with < against;
  const Vec2 way = passage.end().at - passage.begin().at + passage.begin().along;
  return way.dot(kFirst) < 0.0;
}

bool has_shut_door(const View& view, const Passage& passage, double z) {
  const std::vector<DoorSeen> doors = doors_seen(view, z);
  return std::any_of(doors.begin(), doors.end(), [&](const DoorSeen& door) {
    const Vec2 leaf = door.hinge + 0.5 * door.width * door.along;
    return !door.is_passable() && passage.is_near(leaf, kAtDoorway);
  });
}

/// The nearest free place beside the way; where it is if there is none.
Vec2 place_beside(const View& view, const Vec3& feet, const Passage& passage,
                  const std::vector<Other>& others) {
  const Vec2 at = feet.head<2>();
  const Vec2& along = passage.begin().along;
  const Vec2 side(-along.y(), along.x());
  std::vector<Vec2> places;
  for (const double before : kBefore) {
    for (const double beside : kBeside) {
      places.push_back(passage.begin().at - before * along + beside * side);
    }
  }
  std::stable_sort(places.begin(), places.end(), [&](const Vec2& a, const Vec2& b) {
    return (a - at).squaredNorm() < (b - at).squaredNorm();
  });
  for (const Vec2& place : places) {
    const bool taken = std::any_of(others.begin(), others.end(), [&](const Other& other) {
      return (other.at() - place).norm() < kPersonApart;
    });
    if (taken) continue;
    const FloorMap map(view, feet, place, FloorMap::Extent::kStraight);
    if (map.is_clear(at, place) && map.has_floor(view, at, place)) return place;
  }
  return at;
}

}  // namespace

void Passage::add(const Vec2& at, const Vec2& along) {
  const double on = places_.empty() ? 0.0 : end().on + (at - end().at).norm();
  places_.push_back({at, along, on});
}

Passage::Foot Passage::foot(const Vec2& at) const {
  const auto nearer = [&](const Place& a, const Place& b) {
    return (a.at - at).squaredNorm() < (b.at - at).squaredNorm();
  };
  const Place& place = *std::min_element(places_.begin(), places_.end(), nearer);
  const Vec2 way = at - place.at;
  return {place.on + place.along.dot(way), place.along.x() * way.y() - place.along.y() * way.x(),
          place.along};
}

bool Passage::holds(const Vec2& at) const {
  const Foot foot = this->foot(at);
  return foot.on > -kInsideEnds && foot.on < length() + kInsideEnds &&
         std::abs(foot.aside) < kInsideWide;
}

Passage::Vec2 Passage::place_at(double on) const {
  if (on < 0.0) return begin().at + on * begin().along;
  return std::find_if(places_.begin(), places_.end() - 1,
                      [&](const Place& place) { return place.on >= on; })
      ->at;
}

bool Passage::is_near(const Vec2& point, double reach) const {
  return std::any_of(places_.begin(), places_.end(),
                     [&](const Place& place) { return (place.at - point).norm() < reach; });
}

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
    if (passages.empty() || (middle - passages.back().end().at).norm() >= kOneStretch) {
      passages.emplace_back();
    }
    passages.back().add(middle, ahead.normalized());
  }
  return passages;
}

bool have_others_to_go(const View& view, const Vec3& feet) {
  const std::vector<Other> others = others_near(view, feet);
  return std::any_of(others.begin(), others.end(), [&](const Other& other) {
    return other.on_way && (other.at() - feet.head<2>()).norm() < Surroundings::kSight;
  });
}

std::optional<Vec2> place_to_wait(const View& view, const Vec3& feet,
                                  const std::vector<Passage>& passages,
                                  const std::optional<Vec2>& beside) {
  const std::vector<Other> others = others_near(view, feet);
  if (others.empty()) return std::nullopt;
  const Vec2 at = feet.head<2>();
  const auto inside = std::find_if(passages.begin(), passages.end(),
                                   [&](const Passage& passage) { return passage.holds(at); });
  if (inside != passages.end()) {
    if (!must_leave(*inside, at, others)) return std::nullopt;
    return inside->place_at(std::max(inside->foot(at).on - kBack, -kBefore.front()));
  }
  for (const Passage& passage : passages) {
    if (passage.foot(at).on > 0.5 * passage.length()) continue;  // it is past it
    if ((passage.begin().at - at).norm() > (beside ? kClaims + 1.0 : kYieldsAt)) continue;
    if (has_shut_door(view, passage, feet.z()) || may_go_in(passage, at, others)) continue;
    return beside ? *beside : place_beside(view, feet, passage, others);
  }
  return std::nullopt;
}

}  // namespace angen::people
