#include "devices/doorway.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace angen::devices {

namespace {

constexpr double kAcceleration = 1.5;   // m/s^2
constexpr double kFollowGain = 15.0;    // 1/s, from a leaf's lag to its speed
constexpr double kMaxLag = 0.03;        // m, more means that the force is used up
constexpr double kArriveError = 0.001;  // m
constexpr double kStallSpeed = 0.005;   // m/s
constexpr double kObstacleTime = 0.2;   // s without motion while shutting
constexpr double kBlockedTime = 0.6;    // s without motion while opening

}  // namespace

Doorway::Doorway(double max_velocity, double max_force)
    : profile_(max_velocity, kAcceleration), max_velocity_(max_velocity), max_force_(max_force) {}

void Doorway::select(std::vector<Leaf> leaves, const View& view) {
  leaves_ = std::move(leaves);
  travel_ = 0.0;
  for (const Leaf& leaf : leaves_) travel_ = std::max(travel_, std::abs(leaf.open));
  moving_ = false;
  opening_ = leaves_.empty() || share(view) > 0.5;  // without leaves nothing shuts it
  mode_ = opening_ ? Mode::kOpen : Mode::kClosed;
}

double Doorway::share(const View& view) const {
  double sum = 0.0;
  for (const Leaf& leaf : leaves_) sum += view.joint(leaf.joint).position / leaf.open;
  return leaves_.empty() ? 0.0 : sum / static_cast<double>(leaves_.size());
}

double Doorway::position(const View& view) const { return share(view) * travel_; }

void Doorway::open(const View& view) {
  if (mode_ != Mode::kOpen && !(moving_ && opening_)) go(true, view);
}

void Doorway::close(const View& view) {
  if (!leaves_.empty() && mode_ != Mode::kClosed && !(moving_ && !opening_)) go(false, view);
}

void Doorway::go(bool opening, const View& view) {
  opening_ = opening;
  moving_ = true;
  stalled_ = 0.0;
  profile_.start(position(view));
  mode_ = opening ? Mode::kOpening : Mode::kClosing;
}

void Doorway::brake(const Leaf& leaf, double max_force, Outputs& outputs) {
  outputs.motor(leaf.joint, 0.0, max_force);
}

bool Doorway::update(const View& view, Outputs& outputs) {
  if (!moving_) return false;
  const double dt = to_seconds(view.step());
  const double target = opening_ ? travel_ : 0.0;
  double lag = 0.0;
  double fastest = 0.0;
  for (const Leaf& leaf : leaves_) {
    const JointView joint = view.joint(leaf.joint);
    lag = std::max(lag, std::abs(profile_.position() / travel_ * leaf.open - joint.position));
    fastest = std::max(fastest, std::abs(joint.velocity));
  }
  if (lag < kArriveError && profile_.at(target)) {
    for (const Leaf& leaf : leaves_) brake(leaf, max_force_, outputs);
    moving_ = false;
    mode_ = opening_ ? Mode::kOpen : Mode::kClosed;
    return false;
  }
  stalled_ = fastest < kStallSpeed ? stalled_ + dt : 0.0;
  if (!opening_ && (lag > kMaxLag || stalled_ > kObstacleTime)) {
    go(true, view);
    return true;
  }
  if (opening_) mode_ = stalled_ > kBlockedTime ? Mode::kBlocked : Mode::kOpening;
  if (lag < kMaxLag) profile_.advance(target, dt);
  for (const Leaf& leaf : leaves_) {
    const double scale = leaf.open / travel_;
    const double behind = scale * profile_.position() - view.joint(leaf.joint).position;
    const double wanted = scale * profile_.velocity() + kFollowGain * behind;
    const double limit = 1.2 * max_velocity_;
    outputs.motor(leaf.joint, std::clamp(wanted, -limit, limit), max_force_);
  }
  return false;
}

}  // namespace angen::devices
