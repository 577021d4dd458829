#include "people/walker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "people/modes.h"
#include "people/others.h"
#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr double kUsualStep = 1e-3;  // s
constexpr double kTurnGain = 6.0;    // 1/s, from the wrong heading to a yaw rate
constexpr double kMaxTurn = 3.0;     // rad/s
constexpr double kStill = 0.05;      // m/s: slower than this it keeps its heading
constexpr double kComes = 0.1;       // m/s: who is slower stands
constexpr double kPushSpeed = 0.3;   // m/s, against a thing that it shall push
constexpr double kBarely = 0.05;     // m/s: slower than this it is stuck
constexpr double kAlong = 0.2;       // share of a direction that leads along an obstacle
constexpr double kRuns = 1.35;       // m/s
constexpr double kHasStopped = 0.2;  // m/s
constexpr double kFastest = std::numeric_limits<double>::infinity();
constexpr double kTowards = 0.7;  // cosine, of a person who walks towards it
constexpr int kScansPerPlan = 3;

double turn_to(const Walker::Vec2& direction, const LinkView& body) {
  if (direction.norm() < kStill) return 0.0;
  const double heading = std::atan2(direction.y(), direction.x());
  return std::remainder(heading - yaw_of(body.pose.rotation), 2.0 * M_PI);
}

}  // namespace

void Walker::begin(Nanoseconds step) {
  late_ = std::max(0.0, 0.5 * (to_seconds(step) - kUsualStep));
}

Walker::Look Walker::look(const View& view, const Vec3& feet) {
  if (!manner_.looks) return Look::kNone;
  const Nanoseconds now = view.time() / kScanPeriod;
  if (now == looked_at_) return Look::kNone;
  const bool plans = now % kScansPerPlan == 0 || now - looked_at_ > 1;
  looked_at_ = now;
  braking_.invalidate();
  run_braking_.invalidate();
  surroundings_.scan(view, feet);
  return plans ? Look::kPlans : Look::kSees;
}

void Walker::look_down(const View& view, const Vec3& feet) {
  if (!manner_.pushes) return;
  const Nanoseconds now = view.time() / kScanPeriod;
  if (now == looked_down_at_) return;
  looked_down_at_ = now;
  floor_braking_.invalidate();
  floor_.scan_floor(view, feet);
}

const Surroundings& Walker::scan(const View& view, const Vec3& feet) {
  surroundings_.scan(view, feet);
  return surroundings_;
}

void Walker::aim_for(const View& view, const Vec3& feet, const Vec2& to) {
  const bool straight = !manner_.rounds || surroundings_.is_free(feet.head<2>(), to);
  aim_ = straight ? std::nullopt : way_past(view, feet, to);
}

bool Walker::aim_past(const View& view, const Vec3& feet, const Vec2& to) {
  aim_ = way_past(view, feet, to);
  return aim_.has_value();
}

// Around an obstacle. Who walks towards it is passed on the right, and does the same; so is one who
// waits to come, if there is no other way.
std::optional<Walker::Vec2> Walker::way_past(const View& view, const Vec3& feet,
                                             const Vec2& to) const {
  const Vec2 at = feet.head<2>();
  const Vec2 ahead = (to - at).normalized();
  bool aside = false;
  bool round = true;
  for (const Other& other : others_near(view, feet)) {
    const Vec2 way = other.at() - at;
    if (!other.on_way || way.norm() > Surroundings::kSight) continue;
    const bool comes = ahead.dot(other.heading) < -kTowards;
    if (!comes || ahead.dot(way) < kTowards * way.norm()) continue;
    aside = true;
    round = round && other.speed < kComes;
  }
  const auto right = [&] { return aside ? surroundings_.way_aside(at, to) : std::nullopt; };
  std::optional<Vec2> way = round ? surroundings_.way_round(at, to) : right();
  if (!way) way = round ? right() : surroundings_.way_round(at, to);
  return way;
}

void Walker::walk(const LinkView& body, const Vec2& to, double fastest, Outputs& outputs,
                  std::optional<double> turn) {
  const Vec2 way = velocity(body, to, fastest);
  drive(way, turn ? *turn : turn_to(way, body), outputs);
}

void Walker::face(const LinkView& body, const Vec2& direction, Outputs& outputs) {
  drive(Vec2::Zero(), turn_to(direction, body), outputs);
}

void Walker::stand(Outputs& outputs) {
  outputs.drive(link_, Vec3::Zero(), 0.0, force_max_);
  rests_ = true;
}

// It stops before obstacles that it sees, unless it shall push them, and before the end of the
// floor.
Walker::Vec2 Walker::velocity(const LinkView& body, const Vec2& to, double fastest) {
  const Vec2 at = body.pose.position.head<2>();
  const Vec2 way = aim_.value_or(to) - at;
  const double length = way.norm();
  if (length < 1e-9) return Vec2::Zero();
  Vec2 direction = way / length;
  double speed = aim_ ? fastest : std::min(fastest, length / (kAhead + late_));
  if (manner_.looks) {
    double allowed = braking_.limit(surroundings_, at, direction, speed);
    if (slides_ && allowed < kBarely) {
      direction = slid(at, direction);
      allowed = braking_.limit(surroundings_, at, direction, speed);
    }
    speed = std::min(speed, manner_.pushes ? std::max(allowed, kPushSpeed) : allowed);
    if (!manner_.pushes) speed = std::min(speed, limit_of_run(body));
  }
  if (manner_.pushes && !floor_.points().empty()) {
    speed = std::min(speed, floor_braking_.limit(floor_, at, direction, speed));
  }
  return speed * direction;
}

// Who runs does not turn at once: it can stop on the way that it still moves, too.
double Walker::limit_of_run(const LinkView& body) {
  const Vec2 moves = body.linear_velocity.head<2>();
  const double speed = moves.norm();
  runs_ = speed > (runs_ ? kHasStopped : kRuns);
  if (!runs_) return kFastest;
  return run_braking_.limit(surroundings_, body.pose.position.head<2>(), moves / speed, speed);
}

// Without the part of a direction that leads to the nearest obstacle.
Walker::Vec2 Walker::slid(const Vec2& at, const Vec2& direction) const {
  const std::optional<Vec2> nearest = surroundings_.to_nearest(at);
  if (!nearest || direction.dot(*nearest) <= 0.0) return direction;
  const Vec2 along = direction - direction.dot(*nearest) * *nearest;
  return along.norm() > kAlong ? Vec2(along.normalized()) : direction;
}

void Walker::drive(const Vec2& velocity, double turn, Outputs& outputs) {
  rests_ = false;
  outputs.drive(link_, {velocity.x(), velocity.y(), 0.0},
                std::clamp(kTurnGain * turn, -kMaxTurn, kMaxTurn), force_max_);
}

}  // namespace angen::people
