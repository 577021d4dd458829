#include <algorithm>
#include <cmath>

#include "devices/person.h"
#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::devices {

namespace {

constexpr double kMaxPathLag = 0.3;      // m behind the path: further, and the path waits
constexpr double kAhead = 0.35;          // s: it makes for where its path will be then
constexpr double kTurnGain = 6.0;        // 1/s, from the wrong heading to a yaw rate
constexpr double kMaxTurn = 3.0;         // rad/s
constexpr double kCatchUp = 1.3;         // times the path's own speed
constexpr double kThere = 0.01;          // m: tolerance of its goal
constexpr double kFacing = 0.02;         // rad
constexpr double kNearPath = 0.1;        // m: nearer than this it is not held
constexpr Nanoseconds kFreed = kSecond;  // time on its path by which it comes on after it was held
constexpr int kScansPerPlan = 3;
constexpr double kNearRejoin = 0.3;  // m
constexpr double kPushSpeed = 0.3;   // m/s, against a thing that it shall push
constexpr double kTowards = 0.7;     // cosine, of a person who walks towards it
constexpr Nanoseconds kRejoinWithin = 6 * kSecond;

}  // namespace

double Person::turn_to(const Vec2& velocity, const LinkView& body) {
  if (velocity.norm() < 0.05) return 0.0;
  const double heading = std::atan2(velocity.y(), velocity.x());
  return std::remainder(heading - yaw_of(body.pose.rotation), 2.0 * M_PI);
}

void Person::walk(const Path::Place& place, const View& view, bool renew, Outputs& outputs) {
  const LinkView body = view.link(body_);
  if (gives_way(body, view, renew, outputs)) return;
  const Vec2 at = body.pose.position.head<2>();
  const bool near =
      resting_ && place.still() && Vec2(place.x - at.x(), place.y - at.y()).norm() < kPushedAway;
  Scan scan = Scan::kNone;
  if (avoids_ && !near && !waits_at_door_) {
    scan = scan_surroundings(body, view);
    if (scan == Scan::kPlans && rejoin_) {
      const Path::Place end = path_.at(*rejoin_);
      aim_ = way_for(body, view, {end.x, end.y});
    }
    if (scan != Scan::kNone) find_rejoin(body, view);
  }
  const Path::Place ahead = path_.at(clock_ + kPathAhead);
  const bool looks = scan != Scan::kNone;
  if (!near && uses_door(body, view, {ahead.x, ahead.y}, looks, renew, outputs)) return;
  if (rejoin_) return go_round(body, view, renew, outputs);
  const Path::Place goal = path_.at(clock_ + from_seconds(kAhead));
  const Vec2 to(goal.x, goal.y);
  const double lag = std::hypot(place.x - at.x(), place.y - at.y());
  const double turn = std::remainder(goal.yaw - yaw_of(body.pose.rotation), 2.0 * M_PI);
  // Ahead of its place is no reason to wait, so it is the way to the goal that counts.
  const bool waits =
      (to - at).norm() > kMaxPathLag + std::hypot(goal.x - place.x, goal.y - place.y);
  if (!waits) clock_ += view.step();
  if (clock_ > held_clock_ + kFreed) held_ = false;
  const bool on_path = lag < (place.still() ? kThere : kNearPath);
  note_progress(at, nearer_by(at, to) > kProgress, on_path, view);

  const bool there = lag < kThere && std::abs(turn) < kFacing;
  if (place.still() && (there || (resting_ && lag < kPushedAway))) {
    if (!resting_) stand(outputs);
    held_ = false;
    show(Mode::kStanding, body, renew, outputs);
    return;
  }
  aim_.reset();
  const double fastest = std::max(kReturnSpeed, kCatchUp * std::hypot(place.vx, place.vy));
  head_for(steer(body, to, fastest), turn, outputs);
  show(held_ ? Mode::kBlocked : Mode::kWalking, body, renew, outputs);
}

// The path's clock advances up to the point of return, and waits for the person there.
void Person::go_round(const LinkView& body, const View& view, bool renew, Outputs& outputs) {
  const Vec2 at = body.pose.position.head<2>();
  const Path::Place end = path_.at(*rejoin_);
  const Vec2 to(end.x, end.y);
  const Nanoseconds last = *rejoin_ - from_seconds(kAhead);
  if (clock_ < last) clock_ += view.step();
  if (clock_ >= last && (to - at).norm() < kNearRejoin) rejoin_.reset();
  if (clock_ > held_clock_ + kFreed) held_ = false;
  note_progress(at, nearer_by(at, to) > kProgress, false, view);
  const Vec2 velocity = steer(body, to, std::max(kReturnSpeed, std::hypot(end.vx, end.vy)));
  head_for(velocity, turn_to(velocity, body), outputs);
  show(held_ ? Mode::kBlocked : Mode::kWalking, body, renew, outputs);
}

double Person::nearer_by(const Vec2& at, const Vec2& goal) const {
  return (goal - came_to_).norm() - (goal - at).norm();
}

// Ten times a second; a way round is planned with each third scan.
Person::Scan Person::scan_surroundings(const LinkView& body, const View& view) {
  if (!avoids_ && !order_) return Scan::kNone;
  const Nanoseconds now = view.time() / kScanPeriod;
  if (now == scanned_at_) return Scan::kNone;
  const bool plans = now % kScansPerPlan == 0 || now - scanned_at_ > 1;
  scanned_at_ = now;
  braking_.invalidate();
  surroundings_.scan(view, body.pose.position);
  return plans ? Scan::kPlans : Scan::kScanned;
}

std::optional<Person::Vec2> Person::way_for(const LinkView& body, const View& view,
                                            const Vec2& to) const {
  const Vec2 at = body.pose.position.head<2>();
  if ((order_ && order_->pushes) || surroundings_.is_free(at, to)) return std::nullopt;
  return way_past(body, view, to);
}

// Around an obstacle. It passes an approaching person on the right, who does the same.
std::optional<Person::Vec2> Person::way_past(const LinkView& body, const View& view,
                                             const Vec2& to) const {
  const Vec2 at = body.pose.position.head<2>();
  const Vec2 ahead = (to - at).normalized();
  for (const DeviceView& other : Surroundings::other_people(view, body.pose.position)) {
    if (other.state.get<std::string>("mode") == kPersonModes[0]) continue;
    const Vec2 there(other.state.get<double>("x"), other.state.get<double>("y"));
    const double distance = (there - at).norm();
    if (distance > Surroundings::kSight) continue;
    const double yaw = other.state.get<double>("yaw");
    const bool comes = ahead.dot(Vec2(std::cos(yaw), std::sin(yaw))) < -kTowards;
    if (comes && ahead.dot(there - at) > kTowards * distance) {
      return surroundings_.way_aside(at, to);
    }
  }
  return surroundings_.way_round(at, to);
}

// If an obstacle is on the path ahead, or on the way to it: the first place behind the obstacle.
void Person::find_rejoin(const LinkView& body, const View& view) {
  const Vec2 at = body.pose.position.head<2>();
  const auto place_at = [&](Nanoseconds time) {
    const Path::Place place = path_.at(time);
    return Vec2(place.x, place.y);
  };
  const Nanoseconds ahead = from_seconds(kAhead);
  bool blocked = !surroundings_.is_free(at, place_at(clock_ + ahead));
  for (Nanoseconds t = ahead; t <= kPathAhead; t += ahead) {
    blocked = blocked || surroundings_.is_occupied(place_at(clock_ + t));
  }
  if (!blocked) return rejoin_.reset();
  if (rejoin_ && !surroundings_.is_occupied(place_at(*rejoin_))) return;
  rejoin_.reset();
  bool behind = false;
  for (Nanoseconds t = ahead; t < kRejoinWithin; t += kScanPeriod) {
    const Vec2 place = place_at(clock_ + t);
    if ((place - at).norm() > Surroundings::kSight) return;
    if (surroundings_.is_occupied(place)) {
      behind = true;
    } else if (behind || !surroundings_.is_free(at, place)) {
      aim_ = way_past(body, view, place);
      if (aim_) rejoin_ = clock_ + t;
      return;
    }
  }
}

// The velocity towards a place, or the first one of a way round.
Person::Vec2 Person::steer(const LinkView& body, const Vec2& to, double fastest) {
  const Vec2 at = body.pose.position.head<2>();
  const Vec2 way = aim_.value_or(to) - at;
  const double length = way.norm();
  if (length < 1e-9) return Vec2::Zero();
  const Vec2 direction = way / length;
  double speed = aim_ ? fastest : std::min(fastest, length / (kAhead + late_));
  if (avoids_ || order_) speed = slowed(at, direction, speed);
  return speed * direction;
}

// It stops before obstacles that it sees, unless it shall push them.
double Person::slowed(const Vec2& at, const Vec2& direction, double speed) {
  const double allowed = braking_.limit(surroundings_, at, direction, speed);
  const bool pushes = !avoids_ || (order_ && order_->pushes);
  return std::min(speed, pushes ? std::max(allowed, kPushSpeed) : allowed);
}

void Person::head_for(const Vec2& velocity, double turn, Outputs& outputs) {
  resting_ = false;
  outputs.drive(body_, {velocity.x(), velocity.y(), 0.0},
                std::clamp(kTurnGain * turn, -kMaxTurn, kMaxTurn), force_max_);
}

}  // namespace angen::devices
