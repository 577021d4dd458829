#include "devices/doorway.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "plugin/outputs.h"
#include "plugin/view.h"

namespace angen::devices {

namespace {

constexpr double kAcceleration = 1.5;   // m/s^2
constexpr double kFollowGain = 15.0;    // 1/s, from a leaf's lag to its speed
constexpr double kMaxLag = 0.03;        // m, more means that the force is used up
constexpr double kArriveError = 0.001;  // m
constexpr double kStallSpeed = 0.005;   // m/s
constexpr double kObstacleTime = 0.2;   // s without motion while shutting
constexpr double kBlockedTime = 0.6;    // s without motion while opening

// The light curtain, from 0.05 to 1.6 m above the sill of a leaf of 2 m (EN 81-20, 5.3.6.2.2.1).
constexpr int kBeams = 17;
constexpr double kLowestBeam = -0.95;  // m from the middle of a leaf
constexpr double kBetweenBeams = 0.1;  // m
constexpr double kNarrowest = 0.03;    // m between the leaves: less is not watched
constexpr double kBeamSkin = 0.005;    // m before a leaf's edge
constexpr Nanoseconds kBeamPeriod = kSecond / 50;

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
  if (!opening_ && (lag > kMaxLag || stalled_ > kObstacleTime || curtain_broken(view))) {
    go(true, view);
    return true;
  }
  if (opening_) mode_ = stalled_ > kBlockedTime ? Mode::kBlocked : Mode::kOpening;
  if (lag < kMaxLag) profile_.advance(target, dt);
  for (const Leaf& leaf : leaves_) {
    const double scale = leaf.open / travel_;
    const double behind = scale * profile_.position() - view.joint(leaf.joint).position;
    const double target = scale * profile_.velocity() + kFollowGain * behind;
    const double limit = 1.2 * max_velocity_;
    outputs.motor(leaf.joint, std::clamp(target, -limit, limit), max_force_);
  }
  return false;
}

bool Doorway::curtain_broken(const View& view) {
  const Nanoseconds now = view.time() / kBeamPeriod;
  if (now == scanned_at_) return false;
  scanned_at_ = now;
  for (std::size_t i = 1; i < leaves_.size(); ++i) {
    const Leaf& one = leaves_[i - 1];
    if (one.row == leaves_[i].row && is_between(one, leaves_[i], view)) return true;
  }
  return false;
}

// The edges of two leaves are half of the distance of their middles apart from these when shut.
bool Doorway::is_between(const Leaf& one, const Leaf& other, const View& view) {
  const auto middle = [&](const Leaf& leaf) { return view.link(leaf.link).pose * leaf.center; };
  const auto travel = [&](const Leaf& leaf) {
    return Vec3(view.joint(leaf.joint).position * (view.pose().rotation * leaf.axis));
  };
  const Vec3 from = middle(one);
  const Vec3 to = middle(other);
  const double edge = 0.5 * ((to - travel(other)) - (from - travel(one))).norm() + kBeamSkin;
  const double length = (to - from).norm();
  if (length - 2.0 * edge < kNarrowest) return false;
  for (int i = 0; i < kBeams; ++i) {
    const Vec3 height = (kLowestBeam + i * kBetweenBeams) * Vec3::UnitZ();
    for (const rays::Crossing& each : view.rays().crossings(from + height, to + height)) {
      const bool is_around = each.enter <= 0.0 || each.leave >= length;  // a leaf or the floor
      if (!is_around && each.leave > edge && each.enter < length - edge) return true;
    }
  }
  return false;
}

}  // namespace angen::devices
