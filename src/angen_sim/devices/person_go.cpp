// A person's orders, doors on its way, and its behavior when an obstacle holds it.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "devices/person.h"
#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::devices {

namespace {

constexpr double kArrived = 0.03;   // m: nearer than this an order is carried out
constexpr double kCloseBy = 0.22;   // m: so is one that something holds nearer than this
constexpr double kMoved = 0.05;     // m, of one that has arrived: it stays
constexpr double kNearGoal = 0.06;  // m from its goal; a place that fits instead of it
constexpr double kOpenToll = 3.0;   // m that a door which it can open counts
constexpr double kWaitToll = 30.0;  // m that another shut door counts
constexpr double kOnWay = 0.3;      // m: a person that moved this far is no longer held
constexpr double kAround = 0.3;     // m: farther than this is progress on a way round
constexpr double kSeenCell = 0.02;  // m
constexpr double kUnseen = 0.3;     // m to an obstacle that it does not see
constexpr double kStepBack = 1.2;   // m, out of the way of a leaf that opens towards it
constexpr Nanoseconds kStallTime = kSecond;
constexpr Nanoseconds kTimeout = 3 * kSecond;     // after this time it makes room
constexpr Nanoseconds kAway = 5 * kSecond;        // at least: a door opens in less
constexpr Nanoseconds kGivesUp = 15 * kSecond;    // without progress towards where it was sent
constexpr Nanoseconds kStagnates = 10 * kSecond;  // without, and it is held although it moves
constexpr double kCircle = 1.5;                   // m, radius about a place
constexpr Nanoseconds kLingers = 40 * kSecond;    // longer than crossing the circle: it gives up
constexpr Nanoseconds kFirstBlind = 10 * kSecond;
constexpr Nanoseconds kBackStep = kSecond / 20;
constexpr std::size_t kMaxKeptCells = 500'000;  // 6.5 MB
constexpr int kMaxBackSteps = 200;
constexpr int kMaxDoublings = 8;

}  // namespace

// On a map of the static shapes and, if `with_seen`, of seen obstacles. False if no way leads
// there.
bool Person::plan(const View& view, const LinkView& body, bool with_seen) {
  const Vec2 at = body.pose.position.head<2>();
  order_->planned = true;
  route_.reset();
  if (order_->pushes) return true;
  const Vec3& feet = body.pose.position;
  const std::vector<DoorSeen> doors = doors_seen(view, feet.z());
  if (!with_seen && !door_on_way(doors, at, order_->to) &&
      FloorMap(view, feet, order_->to, FloorMap::Extent::kStraight).is_clear(at, order_->to)) {
    return true;
  }
  FloorMap map = map_of_storey(view, feet);
  if (with_seen) map.add_points(seen_);
  for (const DoorSeen& door : doors) {
    if (door.is_passable()) continue;
    map.add_toll(door.hinge, door.edge(), opens_doors_ ? kOpenToll : kWaitToll);
  }
  std::optional<std::vector<Vec2>> way = map.way(view, at, order_->to, kNearGoal);
  if (!way) return !with_seen && Surroundings::is_walkable(view, body.pose.position, order_->to);
  route_.emplace(std::move(map), std::move(*way));
  return true;
}

// Most orders are for places on the same storey of a home, whose static shapes stay.
FloorMap Person::map_of_storey(const View& view, const Vec3& feet) {
  if (storey_ && storey_->serves(view, feet, order_->to)) return *storey_;
  FloorMap map(view, feet, order_->to);
  if (map.cells() <= kMaxKeptCells) storey_ = map;
  return map;
}

void Person::go(const View& view, bool renew, Outputs& outputs) {
  const LinkView body = view.link(body_);
  const Vec2 at = body.pose.position.head<2>();
  const double away = (order_->to - at).norm();
  const double near = held_ ? kCloseBy : kArrived;
  const bool there = away < (order_->arrived && resting_ ? order_->stays_within : near);
  if (!there && !order_->planned) {
    best_at_ = entered_at_ = view.time();
    circle_ = at;
    if (!plan(view, body, false)) give_up(outputs);
  }
  if (!there && lingers(at, view.time()) && !order_->unreachable) give_up(outputs);
  if (there || order_->unreachable) {
    if (!resting_) order_->stays_within = std::max(kPushedAway, away + kMoved);
    order_->arrived = !order_->unreachable;
    held_ = false;
    if (!resting_) stand(outputs);
    show(Mode::kStanding, body, renew, outputs);
    return;
  }
  if (gives_way(body, view, renew, outputs)) return;
  const Scan scan = waits_at_door_ ? Scan::kNone : scan_surroundings(body, view);
  if (scan != Scan::kNone || !target_) target_ = route_ ? route_->follow(at) : order_->to;
  if (uses_door(body, view, *target_, scan != Scan::kNone, renew, outputs)) return;
  if (scan == Scan::kPlans && !seen_.empty()) explore(view, body);
  if (scan == Scan::kPlans) aim_ = way_for(body, view, *target_);
  const double left = way_left(at);
  const bool nearer = came_left_ - left > kProgress;
  if (nearer) came_left_ = left;
  if (left < held_left_ - kOnWay) held_ = false;
  note_progress(at, nearer, false, view);
  const Vec2 velocity = steer(body, *target_, speed_);
  head_for(velocity, turn_to(velocity, body), outputs);
  show(held_ ? Mode::kBlocked : Mode::kWalking, body, renew, outputs);
}

double Person::way_left(const Vec2& at) const {
  return route_ ? route_->left(at) : (order_->to - at).norm();
}

void Person::give_up(Outputs& outputs) {
  order_->unreachable = true;
  waits_ = false;
  std::ostringstream goal;
  goal << order_->to.x() << " " << order_->to.y();
  outputs.event("unreachable", goal.str());
}

bool Person::uses_door(const LinkView& body, const View& view, const Vec2& to, bool looks,
                       bool renew, Outputs& outputs) {
  if (!avoids_ && !order_) return false;
  if (order_ && order_->pushes) return false;
  const DoorUse::Advice advice = doors_.update(view, body.pose.position, to, looks, outputs);
  using Step = DoorUse::Advice::Step;
  waits_at_door_ = advice.step == Step::kWait || advice.step == Step::kFailed;
  if (advice.step == Step::kWalk) return false;
  const Vec2 at = body.pose.position.head<2>();
  stalled_ = 0;
  came_to_ = at;
  best_at_ = view.time();
  if (waits_at_door_) {
    note_held(at);
    if (advice.step == Step::kFailed && order_) take_other_way(body, view, outputs);
    if (!resting_) stand(outputs);
    show(Mode::kBlocked, body, renew, outputs);
    return true;
  }
  if (advice.step == Step::kStand) {
    head_for(Vec2::Zero(), turn_to(advice.to - at, body), outputs);
  } else {
    if (looks) aim_ = way_for(body, view, advice.to);
    const Vec2 velocity = steer(body, advice.to, order_ ? speed_ : kReturnSpeed);
    head_for(velocity, turn_to(velocity, body), outputs);
  }
  show(held_ ? Mode::kBlocked : Mode::kWalking, body, renew, outputs);
  return true;
}

// Instead of the way through a door that does not open.
void Person::take_other_way(const LinkView& body, const View& view, Outputs& outputs) {
  const DoorSeen& door = doors_.door();
  for (double at = 0.0; at < door.width; at += kSeenCell) {
    seen_.push_back(door.hinge + at * door.along);
  }
  failed_.push_back(door.name);
  doors_.reset();
  waits_at_door_ = false;
  target_.reset();
  if (plan(view, body, true)) {
    came_left_ = way_left(body.pose.position.head<2>());
  } else {
    give_up(outputs);
  }
}

// A door that opens towards a person before it needs room: the person steps back the way it came,
// waits there, and continues when it sees a free way. Rarely it tries without seeing one.
bool Person::gives_way(const LinkView& body, const View& view, bool renew, Outputs& outputs) {
  if (stalled_ >= kTimeout) make_room(body, view);
  const Vec2 at = body.pose.position.head<2>();
  if (view.time() < away_until_) {
    scan_surroundings(body, view);
    aim_.reset();
    head_for(steer(body, back_to_, kReturnSpeed), 0.0, outputs);
    came_to_ = at;
    show(Mode::kBlocked, body, renew, outputs);
    return true;
  }
  if (!waits_) return false;
  if (view.time() / kSecond != checked_at_) {
    checked_at_ = view.time() / kSecond;
    if (is_freed(body, view)) {
      waits_ = false;
      resumed_at_ = view.time();
      scanned_at_ = -1;
      stalled_ = 0;
      came_to_ = at;
      return false;
    }
    if (must_give_up(view.time())) {
      give_up(outputs);
      return false;
    }
  }
  if (!resting_) stand(outputs);
  show(Mode::kBlocked, body, renew, outputs);
  return true;
}

bool Person::must_give_up(Nanoseconds now) const {
  return order_ && !order_->pushes && now - waits_since_ > kGivesUp;
}

// New plans that come to nothing may follow each other for ever.
bool Person::lingers(const Vec2& at, Nanoseconds now) {
  const bool rests = order_->arrived && resting_;  // until something pushes it away
  if (rests || waits_at_door_ || order_->pushes || (at - circle_).norm() > kCircle) {
    circle_ = at;
    entered_at_ = now;
  }
  return now - entered_at_ > kLingers + from_seconds(2.0 * kCircle / speed_);
}

bool Person::is_freed(const LinkView& body, const View& view) {
  const Nanoseconds now = view.time();
  if (now >= blind_at_ && (!order_ || order_->pushes)) return true;
  if (now < retry_at_) return false;
  const Vec2 at = body.pose.position.head<2>();
  if (order_ && !order_->pushes) {
    surroundings_.scan(view, body.pose.position);
    learn(view, body.pose.position);
    if (!plan(view, body, true)) return false;
    came_left_ = held_left_ = way_left(at);
    target_.reset();
  } else {
    const Path::Place ahead = path_.at(clock_ + kPathAhead);
    const Vec2 to = order_ ? order_->to : Vec2(ahead.x, ahead.y);
    surroundings_.scan(view, body.pose.position);
    if (!surroundings_.reaches(at, to)) return false;
  }
  ++errors_;  // unless it comes on
  return true;
}

// Adds seen points to the known ones, and removes those that are no longer there.
void Person::learn(const View& view, const Vec3& feet) {
  Surroundings::remove_gone(view, feet, seen_);
  for (const Vec2& point : surroundings_.points()) {
    seen_.push_back(kSeenCell * (point / kSeenCell).array().round().matrix());
  }
  const auto before = [](const Vec2& a, const Vec2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::sort(seen_.begin(), seen_.end(), before);
  seen_.erase(std::unique(seen_.begin(), seen_.end()), seen_.end());
  // A shut door is no obstacle, and what was behind it may be gone.
  for (const DoorSeen& door : doors_seen(view, feet.z())) {
    if (std::count(failed_.begin(), failed_.end(), door.name) > 0) continue;
    const auto is_hidden = [&](const Vec2& at) { return door.hides(at, feet.head<2>()); };
    seen_.erase(std::remove_if(seen_.begin(), seen_.end(), is_hidden), seen_.end());
  }
}

// Once an obstacle has held it on its way, it plans again with all that it sees.
void Person::explore(const View& view, const LinkView& body) {
  learn(view, body.pose.position);
  if (!plan(view, body, true)) return wait(body, view);
  const Vec2 at = body.pose.position.head<2>();
  came_left_ = way_left(at);
  target_ = route_->follow(at);
}

// Adds the obstacles that it sees, and one ahead if it is held by something unseen.
void Person::note_obstacle(const View& view, const LinkView& body) {
  learn(view, body.pose.position);
  const Vec2 at = body.pose.position.head<2>();
  const Vec2 ahead = (target_.value_or(order_->to) - at).normalized();
  if (surroundings_.free_way(at, ahead) > kUnseen) seen_.push_back(at + kUnseen * ahead);
}

// First it looks for another way to where it was sent.
void Person::make_room(const LinkView& body, const View& view) {
  const Nanoseconds now = view.time();
  const Vec2 at = body.pose.position.head<2>();
  stalled_ = 0;
  if (order_ && !order_->pushes) {
    note_obstacle(view, body);
    if (plan(view, body, true)) {
      came_left_ = held_left_ = way_left(at);
      target_.reset();
      best_at_ = now;
      return;
    }
    target_.reset();
  }
  wait(body, view);
}

void Person::wait(const LinkView& body, const View& view) {
  const Nanoseconds now = view.time();
  const Vec2 at = body.pose.position.head<2>();
  note_held(at);
  ++tries_;
  waits_since_ = now;
  away_until_ = now + kAway;
  retry_at_ = now + (kAway << std::min(errors_, kMaxDoublings));
  blind_at_ = now + (kFirstBlind << std::min(tries_, kMaxDoublings));
  waits_ = true;
  back_to_ = at;
  if (order_) {
    back_to_ -= kStepBack * (target_.value_or(order_->to) - at).normalized();
    return;
  }
  Nanoseconds time = clock_;
  for (int i = 0; i < kMaxBackSteps; ++i, time -= kBackStep) {
    const Path::Place place = path_.at(time);
    back_to_ << place.x, place.y;
    if ((back_to_ - at).norm() >= kStepBack) return;
  }
}

// Nearer to the goal is progress, and the way round something, for a while; along a leaf that one
// leans on is none.
void Person::note_progress(const Vec2& at, bool nearer, bool on_path, const View& view) {
  const bool around = aim_ && (at - came_to_).norm() > kAround;
  if (!held_) tries_ = errors_ = 0;
  if (order_ ? nearer : on_path || clock_ > came_clock_) best_at_ = view.time();
  came_clock_ = clock_;
  if (on_path || nearer || around) {
    came_to_ = at;
    stalled_ = 0;
  } else {
    stalled_ += view.step();
  }
  if (view.time() - std::max(best_at_, resumed_at_) > kStagnates)
    stalled_ = std::max(stalled_, kTimeout);
  if (stalled_ >= kStallTime) note_held(at);
}

void Person::note_held(const Vec2& at) {
  if (held_) return;
  held_ = true;
  held_clock_ = clock_;
  held_left_ = order_ ? way_left(at) : 0.0;
}

}  // namespace angen::devices
