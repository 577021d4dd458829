#include "people/seat.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/text.h"
#include "people/floor_map.h"
#include "people/others.h"
#include "people/places.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

using Vec2 = Surroundings::Vec2;

constexpr double kReaches[] = {0.0, 1.4, 2.2};  // m from its feet to a seat or bed, by posture
constexpr double kThatPlace = 0.3;              // m: the place at x y
constexpr double kTaken = 0.35;                 // m between two who sit or lie
constexpr double kLooksFrom = 0.45;             // m above a place: where its surface is looked for
constexpr double kCovered = 0.12;               // m: higher than this a table covers the place
constexpr double kLiesOn = 0.002;               // m between the surface and the body
constexpr double kApartStanding = 0.5;          // m between the middles of two who stand
constexpr double kStandsNear = 1.0;             // m, at most, from where it stood before
constexpr double kEyes = 1.0;                   // m above the floor, over tables and beds
constexpr int kTurns = 8;

bool is_own(const View& view, std::uint32_t shape) {
  const std::vector<std::uint32_t> own = view.own_shapes();
  return std::count(own.begin(), own.end(), shape) != 0;
}

// The name of who is there.
std::string occupant(const View& view, const Vec3& feet, const Vec2& place, double within) {
  for (const Other& other : others_near(view, feet)) {
    if ((other.at() - place).norm() < within) return std::string(other.name);
  }
  return "";
}

// z of the highest surface under a body, m.
double support(const View& view, const FloorPose& place, Posture posture) {
  const bool lies = posture == Posture::kLie;
  const Pose pose{place.position, from_rpy(0.0, 0.0, place.yaw)};
  double highest = -std::numeric_limits<double>::infinity();
  for (double along = lies ? -0.7 : -0.1; along < (lies ? 0.45 : 0.15); along += 0.1) {
    for (const double across : {-0.15, -0.05, 0.05, 0.15}) {
      const Vec3 from = pose * Vec3(along, across, kLooksFrom);
      for (const rays::Crossing& c :
           view.rays().crossings(from, from - 2.0 * kLooksFrom * Vec3::UnitZ())) {
        if (!is_own(view, c.shape)) highest = std::max(highest, from.z() - c.enter);
      }
    }
  }
  return highest;
}

// The direction in which there is room to lie on the floor, the present one first.
std::optional<Quat> direction_to_lie(const View& view, const Pose& body) {
  for (int turn = 0; turn < kTurns; ++turn) {
    const Quat to = from_rpy(0.0, 0.0, yaw_of(body.rotation) + 2.0 * M_PI * turn / kTurns);
    const Pose lies{body.position, to};
    bool is_free = true;
    for (const double across : {-0.2, 0.0, 0.2}) {
      const auto met =
          view.rays().crossings(lies * Vec3(-0.95, across, 0.15), lies * Vec3(0.8, across, 0.15));
      is_free = is_free && std::all_of(met.begin(), met.end(), [&](const rays::Crossing& c) {
                  return is_own(view, c.shape);
                });
    }
    if (is_free) return to;
  }
  return std::nullopt;
}

struct Wanted {
  Posture posture;
  std::string thing;         // empty: any
  std::optional<Vec2> near;  // none: any
};

FoundSeat at_place(const Wanted& wanted, const View& view, const Vec3& feet) {
  const std::string posture = kPostures[static_cast<int>(wanted.posture)];
  const Home& home = view.home();
  double least = std::numeric_limits<double>::infinity();
  FoundSeat found;
  for (const Thing& thing : home.things) {
    if (!wanted.thing.empty() && !is_same(thing.name, wanted.thing)) continue;
    for (const Place& place : thing.places) {
      const Vec2 at = place.pose.position.head<2>();
      const double away = (at - feet.head<2>()).norm();
      const double rating = wanted.near ? (at - *wanted.near).norm() : away;
      if (place.posture != posture || away > kReaches[static_cast<int>(wanted.posture)] ||
          rating >= least || (wanted.near && rating > kThatPlace) ||
          floor_at(home.storeys, place.pose.position.z()) != floor_at(home.storeys, feet.z())) {
        continue;
      }
      const std::string other = occupant(view, feet, at, kTaken);
      const double z = support(view, place.pose, wanted.posture);
      if (!other.empty() || !std::isfinite(z) || z > place.pose.position.z() + kCovered) {
        found.why_not = (other.empty() ? "something" : other) + " is on " + thing.name;
        continue;
      }
      least = rating;
      found.seat = Seat{wanted.posture,
                        {{at.x(), at.y(), z + kLiesOn}, from_rpy(0.0, 0.0, place.pose.yaw)},
                        feet};
    }
  }
  return found;
}

}  // namespace

FoundSeat find_seat(const Command& command, const View& view, const Pose& body) {
  const Vec3& feet = body.position;
  const bool lies = command.verb == "Lie";
  Wanted wanted{lies ? Posture::kLie : Posture::kSit, command.place, std::nullopt};
  if (!command.values.empty()) wanted.near = Vec2(command.values[0], command.values[1]);
  FoundSeat found = at_place(wanted, view, feet);
  if (found.seat) return found;
  const bool is_here = !wanted.near || (*wanted.near - feet.head<2>()).norm() < kThatPlace;
  if (lies && wanted.thing.empty() && is_here) {
    const std::optional<Quat> to = direction_to_lie(view, body);
    if (!to) return {{}, "there is no room to lie on the floor"};
    return {Seat{Posture::kLie, {feet + kLiesOn * Vec3::UnitZ(), *to}, feet}, ""};
  }
  if (!found.why_not.empty()) return found;
  std::string what = lies ? "bed" : "seat";
  if (!wanted.thing.empty()) what += " of " + printable(wanted.thing);
  if (wanted.near) what += text_of(" at ", wanted.near->x(), " ", wanted.near->y());
  return {{},
          text_of("no ", what, " is within ", kReaches[lies ? 2 : 1],
                  " m of it; send it there by GoTo first")};
}

std::optional<Vec3> free_place_beside(const View& view, const Vec3& to, double reach) {
  const Vec2 middle = to.head<2>();
  const Vec2 box = Vec2::Constant(reach);
  const auto is_clear = [&](const Vec3& from, const Vec3& end, rays::Mobilities of) {
    const auto met = view.rays().crossings(from, end, of);
    return std::all_of(met.begin(), met.end(),
                       [&](const rays::Crossing& c) { return is_own(view, c.shape); });
  };
  const auto rate = [&](const Vec2& at) {
    const Vec3 low(at.x(), at.y(), to.z() + kLow);  // a bed may be a thing that can move
    const Vec3 high = low + Vec3::UnitZ();
    const bool is_free =
        occupant(view, to, at, kApartStanding).empty() && is_clear(high, low, rays::kAll) &&
        is_clear(to + kEyes * Vec3::UnitZ(), high, rays::only(rays::Mobility::kStatic));
    return is_free ? 2.0 * reach - (at - middle).norm() : 0.0;
  };
  const auto place = best_place(view, {middle - box, middle + box}, to.z(), rate);
  if (!place) return std::nullopt;
  return Vec3(place->x(), place->y(), to.z());
}

std::optional<Vec3> place_to_stand(const View& view, const Seat& seat) {
  const bool is_free = occupant(view, seat.stand, seat.stand.head<2>(), kApartStanding).empty();
  return is_free ? seat.stand : free_place_beside(view, seat.stand, kStandsNear);
}

}  // namespace angen::people
