#include "people/walker.h"

#include <algorithm>
#include <cmath>

#include "people/modes.h"
#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr double kUsualStep = 1e-3;  // s
constexpr double kTurnGain = 6.0;    // 1/s, from the wrong heading to a yaw rate
constexpr double kMaxTurn = 3.0;     // rad/s
constexpr double kStill = 0.05;      // m/s: slower than this it keeps its heading
constexpr double kPushSpeed = 0.3;   // m/s, against a thing that it shall push
constexpr double kComes = 0.1;       // m/s: who is slower stands
constexpr double kBarely = 0.05;     // m/s: slower than this it is stuck
constexpr double kAlong = 0.2;       // share of a direction that leads along an obstacle
constexpr double kTowards = 0.7;     // cosine, of a person who walks towards it
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
  surroundings_.scan(view, feet);
  return plans ? Look::kPlans : Look::kSees;
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

// Around an obstacle. It passes an approaching person on the right, who does the same.
std::optional<Walker::Vec2> Walker::way_past(const View& view, const Vec3& feet,
                                             const Vec2& to) const {
  const Vec2 at = feet.head<2>();
  const Vec2 ahead = (to - at).normalized();
  for (const DeviceView& other : Surroundings::other_people(view, feet)) {
    if (other.state.get<double>("speed") < kComes) continue;
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

void Walker::walk(const LinkView& body, const Vec2& to, double fastest, Outputs& outputs,
                  std::optional<double> turn) {
  const Vec2 way = velocity(body.pose.position.head<2>(), to, fastest);
  drive(way, turn ? *turn : turn_to(way, body), outputs);
}

void Walker::face(const LinkView& body, const Vec2& direction, Outputs& outputs) {
  drive(Vec2::Zero(), turn_to(direction, body), outputs);
}

void Walker::stand(Outputs& outputs) {
  outputs.drive(link_, Vec3::Zero(), 0.0, force_max_);
  rests_ = true;
}

// It stops before obstacles that it sees, unless it shall push them.
Walker::Vec2 Walker::velocity(const Vec2& at, const Vec2& to, double fastest) {
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
  }
  return speed * direction;
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
