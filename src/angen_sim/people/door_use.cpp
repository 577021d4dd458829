#include "people/door_use.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "people/floor_map.h"
#include "people/others.h"
#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr double kNeeded = 0.62;                    // m, free width for a person
constexpr double kAlone = 0.8;                      // m, a leaf this wide suffices
constexpr double kStoreyWithin = 1.0;               // m, from a person's feet to the foot of a door
constexpr double kReach = 1.1;                      // m from a person's middle to a handle
constexpr double kAtSpot = 0.07;                    // m
constexpr double kKeptFrom = 1.0;                   // m from a spot: something there can move
constexpr double kBeforeHandle = 0.5;               // m, to push or slide
constexpr double kHandleInside = 0.07;              // m, of a leaf's edge
constexpr double kOutOfSwing = 0.37;                // m beyond the leaf's edge
constexpr double kLeafSkin = 0.1;                   // m, from the line of a shut leaf to its sides
constexpr double kBothStand = 0.5;                  // m, between two people
constexpr double kBehind = 0.4;                     // m past a door, to close it
constexpr double kForgets = 4.0;                    // m
constexpr double kNearby = 2.5;                     // m: doors that may be in the way
constexpr double kSeesDoor = 2.0;                   // m, before the leaf
constexpr double kPassesBeside = 0.35;              // m, from a leaf to a person's middle
constexpr Nanoseconds kNearEnough = 3 * kSecond;    // then it opens from where it can reach
constexpr Nanoseconds kLongest = 8 * kSecond;       // longest time of each phase
constexpr Nanoseconds kRobotLeaves = 20 * kSecond;  // the swing of a door
constexpr Nanoseconds kRefresh = kSecond / 50;      // period of a door's state
constexpr Nanoseconds kStarts = kSecond / 5;        // until the door's state shows the hand
constexpr Nanoseconds kRests = 30 * kSecond;  // after a door that did not open, then twice that
constexpr int kRestDoublings = 7;

// deg from the shut leaf to the person's place to pull it, the best first
constexpr double kSpots[] = {45.0, 35.0, 55.0, 25.0, 65.0, 15.0};
constexpr double kDoubleSpots[] = {60.0, 70.0, 80.0};  // spots of a double door

// Places to shut an open leaf: deg from the shut leaf, and m beyond its edge.
constexpr double kShutFirst = 15.0;
constexpr double kShutLast = 165.0;
constexpr double kShutStep = 5.0;
constexpr double kShutBeyond[] = {0.37, 0.52, 0.67, 0.97};
constexpr double kHandleHeight = 1.05;

double cross_of(const Surroundings::Vec2& a, const Surroundings::Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The intersection of two segments, as a share of the first; none if there is none.
std::optional<double> meeting(const Surroundings::Vec2& a, const Surroundings::Vec2& b,
                              const Surroundings::Vec2& c, const Surroundings::Vec2& d) {
  const double turned = cross_of(b - a, d - c);
  if (std::abs(turned) < 1e-9) return std::nullopt;
  const double first = cross_of(c - a, d - c) / turned;
  const double second = cross_of(c - a, b - a) / turned;
  if (first < 0.0 || first > 1.0 || second < 0.0 || second > 1.0) return std::nullopt;
  return first;
}

const HomeDoor* door_of(const Home& home, std::string_view name) {
  return home.door(HomeDoor::Kind::kDoor, name);
}

/// The other leaf of a double door, where one alone is narrow and both open to the same side.
void find_partner(const Home& home, const std::vector<DoorSeen>& doors, DoorSeen& door) {
  if (door.width >= kAlone) return;
  const HomeDoor* known = door_of(home, door.name);
  if (known == nullptr) return;
  for (const DoorSeen& other : doors) {
    if (other.name != known->partner || other.slides != door.slides) continue;
    if (!door.slides && door.into.dot(other.into) < 0.9) continue;
    door.partner = other.name;
    door.partner_mode = other.mode;
  }
}

/// Whether another person than the one at `feet` stands there.
bool is_taken(const View& view, const Vec3& feet, const Surroundings::Vec2& place) {
  const std::vector<Other> others = others_near(view, feet);
  return std::any_of(others.begin(), others.end(),
                     [&](const Other& other) { return (other.at() - place).norm() < kBothStand; });
}

/// Whether a person at a place can shut an open leaf by hand: within reach, out of the swing, and
/// on the side that the leaf opens to.
bool can_shut_from(const View& view, double z, const DoorSeen& door,
                   const Surroundings::Vec2& place) {
  const Surroundings::Vec2 from_hinge = place - door.hinge;
  const double away = from_hinge.norm();
  if (away < door.width + kOutOfSwing - kAtSpot || away > kNearby) return false;
  if (door.into.dot(from_hinge) < 0.0) return false;
  const Surroundings::Vec2 edge = door.hinge + door.width * door.open;
  const double height = z + kHandleHeight;
  return view.rays()
      .crossings({place.x(), place.y(), height}, {edge.x(), edge.y(), height},
                 rays::only(rays::Mobility::kStatic))
      .empty();
}

enum class Whose { kRobots, kAll };

/// Whether a robot, or anybody but the person at `feet`, is where a door's leaves swing.
bool is_swing_taken(const View& view, const Vec3& feet, const DoorSeen& door, Whose whose) {
  const Surroundings::Vec2 other = door.hinge + 2.0 * door.width * door.along;
  const auto is_there = [&](const Vec3& place) {
    const Surroundings::Vec2 at = place.head<2>();
    const double away = door.partner.empty()
                            ? (at - door.hinge).norm()
                            : std::min((at - door.hinge).norm(), (at - other).norm());
    return std::abs(place.z() - feet.z()) < kStoreyWithin && away < door.width + kOutOfSwing;
  };
  for (const DeviceView& device : view.devices("work")) {
    if (device.kind == "drive" && is_there(device.pose.position)) return true;
  }
  if (whose == Whose::kRobots) return false;
  const std::vector<Other> others = others_near(view, feet);
  return std::any_of(others.begin(), others.end(),
                     [&](const Other& other) { return is_there(other.feet); });
}

/// The model that its leaf meets first as it opens; empty if none is there.
std::string in_the_way(const View& view, const Vec3& feet, const DoorSeen& door) {
  for (double away = kLeafSkin; away < door.width; away += kLeafSkin) {
    for (const double height : {0.2, 0.6, 1.2}) {
      const auto at = [&](double along) {
        const Surroundings::Vec2 place = door.hinge + along * door.along + away * door.into;
        return Vec3(place.x(), place.y(), feet.z() + height);
      };
      for (const rays::Crossing& c :
           view.rays().crossings(at(kLeafSkin), at(door.width - kLeafSkin))) {
        const std::string model = view.model_of(c.shape);
        const std::vector<std::uint32_t> own = view.own_shapes();
        if (model != door.model && std::count(own.begin(), own.end(), c.shape) == 0) return model;
      }
    }
  }
  return "";
}

/// Where its leaf turns or slides; false where that is not known.
bool place(const Reading& state, const HomeDoor* home, DoorSeen& door) {
  door.slides = state.find("opens") == nullptr;
  if (!door.slides) {
    const auto& hinge = state.get<std::vector<double>>("hinge");
    const double shut = state.get<double>("shut");
    const double turned = std::copysign(M_PI / 2, state.get<double>("opens"));
    door.hinge << hinge[0], hinge[1];
    door.along << std::cos(shut), std::sin(shut);
    door.into << std::cos(shut + turned), std::sin(shut + turned);
    const double open = shut + state.get<double>("opens");
    door.open << std::cos(open), std::sin(open);
    return true;
  }
  if (home == nullptr) return false;
  const double yaw = home->pose.yaw;
  door.along << std::cos(yaw), std::sin(yaw);
  door.into << -std::sin(yaw), std::cos(yaw);
  door.hinge = home->pose.position.head<2>() - 0.5 * door.width * door.along;
  return true;
}

}  // namespace

bool DoorSeen::is_passable() const { return gap >= std::min(kNeeded, 0.9 * width); }

std::optional<double> DoorSeen::way_to_leaf(const Vec2& at, const Vec2& to) const {
  if (!is_open()) return std::nullopt;
  const Vec2 tip = hinge + (width + Surroundings::kBody) * open;
  const std::optional<double> share = meeting(at, to, hinge, tip);
  if (!share || *share * (to - at).norm() > Surroundings::kSight) return std::nullopt;
  return *share * (to - at).norm();
}

bool DoorSeen::has_on_leaf(const Vec2& point) const {
  if (!is_open()) return false;
  const double at = std::clamp(open.dot(point - hinge), 0.0, width);
  return (point - hinge - at * open).norm() < kLeafSkin;
}

bool DoorSeen::hides(const Vec2& point, const Vec2& from) const {
  if (is_passable()) return false;
  const Vec2 offset = point - hinge;
  const double at = along.dot(offset);
  const bool on_leaf = std::abs(into.dot(offset)) < kLeafSkin && at > 0.0 && at < width;
  return on_leaf || meeting(from, point, hinge, edge()).has_value();
}

std::vector<DoorSeen> doors_seen(const View& view, double z) {
  const Home& home = view.home();
  std::vector<DoorSeen> doors;
  for (const DeviceView& device : view.devices("gap")) {
    if (device.kind != "door") continue;
    const HomeDoor* known = door_of(home, device.name);
    // A hinge may be at any height of its leaf.
    const auto* hinge = device.state.get_if<std::vector<double>>("hinge");
    if (known == nullptr && hinge == nullptr) continue;
    const double foot = known != nullptr ? known->pose.position.z() : hinge->at(2);
    if (std::abs(foot - z) > kStoreyWithin) continue;
    DoorSeen door;
    door.name = std::string(device.name);
    door.model = std::string(device.model);
    door.mode = device.state.get<std::string>("mode");
    door.width = device.state.get<double>("width");
    door.gap = device.state.get<double>("gap");
    if (place(device.state, known, door)) doors.push_back(std::move(door));
  }
  return doors;
}

std::optional<DoorSeen> door_on_way(const std::vector<DoorSeen>& doors,
                                    const Surroundings::Vec2& at, const Surroundings::Vec2& to,
                                    Passable passable) {
  std::optional<DoorSeen> found;
  double nearest = 2.0;
  for (const DoorSeen& door : doors) {
    if (door.is_passable() != (passable == Passable::kYes)) continue;
    const std::optional<double> share = meeting(at, to, door.hinge, door.edge());
    if (!share || *share >= nearest) continue;
    nearest = *share;
    found = door;
  }
  return found;
}

std::vector<Surroundings::Vec2> places_to_shut(const View& view, const Vec3& feet,
                                               const DoorSeen& door) {
  using Vec2 = Surroundings::Vec2;
  if (!door.is_open() || is_swing_taken(view, feet, door, Whose::kAll)) return {};
  std::vector<Vec2> places{feet.head<2>()};
  for (const double beyond : kShutBeyond) {
    for (double degrees = kShutFirst; degrees <= kShutLast; degrees += kShutStep) {
      const double angle = degrees * M_PI / 180.0;
      const Vec2 away = std::cos(angle) * door.along + std::sin(angle) * door.into;
      places.emplace_back(door.hinge + (door.width + beyond) * away);
    }
  }
  const auto is_no_place = [&](const Vec2& place) {
    return !can_shut_from(view, feet.z(), door, place) || is_taken(view, feet, place);
  };
  places.erase(std::remove_if(places.begin(), places.end(), is_no_place), places.end());
  std::stable_sort(places.begin(), places.end(), [&](const Vec2& a, const Vec2& b) {
    return (a - feet.head<2>()).squaredNorm() < (b - feet.head<2>()).squaredNorm();
  });
  return places;
}

Surroundings::Vec2 up_to_door(const View& view, const Vec3& feet, const Surroundings::Vec2& to) {
  const Surroundings::Vec2 at = feet.head<2>();
  const std::optional<DoorSeen> door = door_on_way(doors_seen(view, feet.z()), at, to);
  if (!door) return to;
  const double share = meeting(at, to, door->hinge, door->edge()).value_or(1.0);
  return at + std::max(0.0, share - kBeforeHandle / (to - at).norm()) * (to - at);
}

void DoorUse::enter(Phase phase, Nanoseconds now) {
  phase_ = phase;
  since_ = now;
  closes_off_.reset();
  missed_.reset();
}

// Close to a door, before a corner of its opening, no straight way leads through.
void DoorUse::look(const View& view, const Vec3& feet, const std::vector<Vec2>& places) {
  const Vec2 at = feet.head<2>();
  const std::vector<DoorSeen> doors = doors_seen(view, feet.z());
  std::optional<DoorSeen> next;
  for (const Vec2& place : places) {
    if (!next) next = door_on_way(doors, at, place);
  }
  const auto is_near = [&] {
    return next && std::abs(next->into.dot(at - next->hinge)) < kSeesDoor;
  };
  Phase then = Phase::kApproach;
  if (!is_near() && closes_ && phase_ == Phase::kNone) {  // behind it, it may be shut
    next = door_on_way(doors, at, places.front(), Passable::kYes);
    then = Phase::kPassing;
  }
  if (!is_near()) return;
  find_partner(view.home(), doors, *next);
  door_ = *next;
  side_ = door_.into.dot(at - door_.hinge) > 0.0 ? 1.0 : -1.0;
  if (then == Phase::kApproach) spot_ = free_spot(view, feet);
  enter(then, view.time());
}

bool DoorUse::refresh(const View& view, double z) {
  const std::vector<DoorSeen> doors = doors_seen(view, z);
  for (const DoorSeen& door : doors) {
    if (door.name != door_.name) continue;
    door_ = door;
    find_partner(view.home(), doors, door_);
    return true;
  }
  return false;
}

// The handle of a sliding leaf is reached from before its middle.
DoorUse::Vec2 DoorUse::handle() const {
  const double at = door_.slides ? 0.5 * door_.width : door_.width - kHandleInside;
  return door_.hinge + at * door_.along;
}

// To push or slide: close. To pull: at arm's length from the handle, out of the leaf's way, where a
// wall leaves it room.
DoorUse::Vec2 DoorUse::free_spot(const View& view, const Vec3& feet) const {
  return pulls() ? pull_spot(view, feet) : handle() + side_ * kBeforeHandle * door_.into;
}

DoorUse::Vec2 DoorUse::pull_spot(const View& view, const Vec3& feet) const {
  const std::vector<Vec2> places = spots();
  for (const Vec2& place : places) {
    if (is_taken(view, feet, place) || (missed_ && (place - *missed_).norm() < kAtSpot)) continue;
    if (FloorMap(view, feet, place, FloorMap::Extent::kStraight).is_free(place)) return place;
  }
  return places.front();
}

std::vector<DoorUse::Vec2> DoorUse::spots() const {
  const auto at = [&](const Vec2& hinge, const Vec2& along, double degrees) -> Vec2 {
    const double angle = degrees * M_PI / 180.0;
    const Vec2 away = std::cos(angle) * along + std::sin(angle) * door_.into;
    return hinge + (door_.width + kOutOfSwing) * away;
  };
  std::vector<Vec2> places;
  if (door_.partner.empty()) {
    for (const double degrees : kSpots) places.push_back(at(door_.hinge, door_.along, degrees));
    return places;
  }
  // Before the middle of a double door, or farther aside, out of the way of both leaves.
  const double away = std::sqrt(kOutOfSwing * (2.0 * door_.width + kOutOfSwing));
  places.push_back(door_.edge() + away * door_.into);
  const Vec2 other = door_.hinge + 2.0 * door_.width * door_.along;
  for (const double degrees : kDoubleSpots) {
    places.push_back(at(door_.hinge, door_.along, degrees));
    places.push_back(at(other, -door_.along, degrees));
  }
  return places;
}

DoorUse::Advice DoorUse::update(const View& view, const Vec3& feet, const std::vector<Vec2>& places,
                                Outputs& outputs) {
  if (!places.empty() && (phase_ == Phase::kNone || phase_ == Phase::kPassing))
    look(view, feet, places);
  if (phase_ == Phase::kNone) return {};
  if (view.time() - refreshed_ >= kRefresh) {
    refreshed_ = view.time();
    if (!refresh(view, feet.z())) reset();
  }
  const Vec2 at = feet.head<2>();
  switch (phase_) {
    case Phase::kApproach:
      if (!places.empty() && is_in_swing(at) && is_taken(view, feet, spot_))
        spot_ = free_spot(view, feet);
      return approach(view, feet, outputs);
    case Phase::kOpening:
      return wait_until_open(view, feet);
    case Phase::kWaiting:
      if (door_.is_passable()) {
        enter(Phase::kPassing, view.time());
        return {};
      }
      if (opens_ && view.time() >= tries_at_) enter(Phase::kApproach, view.time());
      return {Advice::Step::kWait, handle()};
    case Phase::kPassing:
      return pass(view, feet, outputs);
    case Phase::kToLeaf:
      return shut(view, feet, outputs);
    case Phase::kClosing: {
      const bool starts = view.time() - since_ < kStarts;
      const bool late = view.time() - since_ > kLongest;
      if (late || (!starts && door_.mode != "CLOSING")) reset();
      return {Advice::Step::kStand, door_.hinge + 0.5 * door_.width * door_.along};
    }
    default:
      return {};
  }
}

DoorUse::Advice DoorUse::approach(const View& view, const Vec3& feet, Outputs& outputs) {
  const Vec2 at = feet.head<2>();
  const Nanoseconds now = view.time();
  if (door_.is_passable()) {
    enter(Phase::kPassing, now);
    return {};
  }
  const bool opens = door_.mode == "OPENING";  // another person opens it
  if (opens && !is_in_swing(at)) {
    enter(Phase::kOpening, now);
    return {Advice::Step::kStand, handle()};
  }
  const Nanoseconds time = now - since_;
  const double away = (at - spot_).norm();
  const bool is_kept = time > kNearEnough && away > kAtSpot && away < kKeptFrom;
  if (is_kept && pulls() && !missed_) {
    missed_ = spot_;
    spot_ = pull_spot(view, feet);
    since_ = now;
    return {Advice::Step::kGo, spot_};
  }
  const bool reaches = time > kNearEnough && (at - handle()).norm() < kReach && !is_in_swing(at);
  if (!opens && (away < kAtSpot || reaches)) return open(view, feet, outputs);
  if (time > kLongest) return fail(view, feet, "is out of its reach");
  return {Advice::Step::kGo, spot_};
}

// It stands where it can open the door.
DoorUse::Advice DoorUse::open(const View& view, const Vec3& feet, Outputs& outputs) {
  const Nanoseconds now = view.time();
  if (!opens_) {
    enter(Phase::kWaiting, now);
    return {Advice::Step::kWait, handle()};
  }
  if (!door_.slides && is_swing_taken(view, feet, door_, Whose::kRobots)) {
    if (now - since_ > kRobotLeaves) return fail(view, feet, "does not open");
    return {Advice::Step::kStand, handle()};
  }
  outputs.event("opens", door_.name);
  outputs.command("door", door_.name, "OpenByHand");
  if (!door_.partner.empty()) outputs.command("door", door_.partner, "OpenByHand");
  enter(Phase::kOpening, now);
  return {Advice::Step::kStand, handle()};
}

// Where a leaf that opens would hit it.
bool DoorUse::is_in_swing(const Vec2& at) const {
  if (!pulls()) return false;
  const double reach = door_.width + kOutOfSwing - kAtSpot;
  const Vec2 other = door_.hinge + 2.0 * door_.width * door_.along;
  const bool of_other = !door_.partner.empty() && (at - other).norm() < reach;
  return of_other || (at - door_.hinge).norm() < reach;
}

DoorUse::Advice DoorUse::wait_until_open(const View& view, const Vec3& feet) {
  const Nanoseconds now = view.time();
  const Nanoseconds time = now - since_;
  if (door_.is_passable() && (!moves() || time > kLongest)) {
    failures_ = 0;
    enter(Phase::kPassing, now);
    return {};
  }
  if (time > kLongest || (time > kStarts && !moves())) {
    return fail(view, feet, "does not open");
  }
  return {Advice::Step::kStand, handle()};
}

DoorUse::Advice DoorUse::fail(const View& view, const Vec3& feet, const std::string& why) {
  const Nanoseconds now = view.time();
  const std::string holds = in_the_way(view, feet, door_);
  why_ = "door " + door_.name + " " + why + (holds.empty() ? "" : ": " + holds + " holds it");
  tries_at_ = now + (kRests << std::min(failures_++, kRestDoublings));
  enter(Phase::kWaiting, now);
  return {Advice::Step::kFailed, handle()};
}

DoorUse::Advice DoorUse::pass(const View& view, const Vec3& feet, Outputs& outputs) {
  const Vec2 from_hinge = feet.head<2>() - door_.hinge;
  if (from_hinge.norm() > door_.width + kForgets) {
    reset();
    return {};
  }
  const double past = -side_ * door_.into.dot(from_hinge);
  const bool swings_here = side_ < 0.0 && !door_.slides;
  const double clear = swings_here ? from_hinge.norm() - door_.width - kOutOfSwing : 0.0;
  if (!closes_off_) {
    closes_off_ = closes_off(view, feet);
    if (*closes_off_ && swings_here) spot_ = pull_spot(view, feet);
  }
  if (clear < -kAtSpot && *closes_off_ && view.time() - since_ < kLongest) {
    return {Advice::Step::kGo, spot_};  // out of the swing
  }
  if (past < kBehind || clear < -kAtSpot) return {};
  if (!(closes_ || *closes_off_) || is_swing_taken(view, feet, door_, Whose::kAll)) {
    reset();
    return {};
  }
  outputs.event("closes", door_.name);
  outputs.command("door", door_.name, "CloseByHand");
  if (!door_.partner.empty()) outputs.command("door", door_.partner, "CloseByHand");
  if (!*closes_off_) {  // it goes on while the leaf shuts
    reset();
    return {};
  }
  enter(Phase::kClosing, view.time());
  return {Advice::Step::kStand, handle()};
}

void DoorUse::go_and_shut(const DoorSeen& door, const Vec2& place, Nanoseconds now) {
  door_ = door;
  spot_ = place;
  enter(Phase::kToLeaf, now);
}

bool DoorUse::wait_for_leaf(const View& view, const Vec3& feet) {
  for (const DoorSeen& door : doors_seen(view, feet.z())) {
    const bool swings = !door.slides && door.mode == "CLOSING";
    if (!swings || !can_shut_from(view, feet.z(), door, feet.head<2>())) continue;
    door_ = door;
    enter(Phase::kClosing, view.time());
    return true;
  }
  return false;
}

DoorUse::Advice DoorUse::shut(const View& view, const Vec3& feet, Outputs& outputs) {
  const bool late = view.time() - since_ > kLongest;
  if (late || !door_.is_open() || is_swing_taken(view, feet, door_, Whose::kRobots)) {
    reset();
    return {};
  }
  if (!can_shut_from(view, feet.z(), door_, feet.head<2>()) ||
      is_swing_taken(view, feet, door_, Whose::kAll)) {
    return {Advice::Step::kGo, spot_};
  }
  outputs.event("closes", door_.name);
  outputs.command("door", door_.name, "CloseByHand");
  enter(Phase::kClosing, view.time());
  return {Advice::Step::kStand, handle()};
}

bool DoorUse::shut_nearby(const View& view, const Vec3& feet, Outputs& outputs,
                          const std::string& model) const {
  bool any = false;
  for (const DoorSeen& door : doors_seen(view, feet.z())) {
    const double away = (feet.head<2>() - door.hinge).norm();
    if (!model.empty() && door.model != model) continue;
    if (!opens_ || !door.is_open() || away > kNearby || away < door.width + kOutOfSwing - kAtSpot ||
        is_swing_taken(view, feet, door, Whose::kAll)) {
      continue;
    }
    outputs.event("closes", door.name);
    outputs.command("door", door.name, "CloseByHand");
    any = true;
  }
  return any;
}

// Whether nobody gets past its open leaf to a place behind it.
bool DoorUse::closes_off(const View& view, const Vec3& feet) const {
  if (!opens_ || door_.slides) return false;
  const Vec2 beyond = door_.hinge + (door_.width + kPassesBeside) * door_.open;
  const Vec2 behind = door_.hinge + 0.5 * door_.width * door_.open - kPassesBeside * door_.along;
  FloorMap map(view, feet, beyond, FloorMap::Extent::kStraight);
  return !map.is_free(beyond) && map.is_free(behind);
}

}  // namespace angen::people
