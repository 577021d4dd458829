#include "devices/servo.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace angen::devices {

namespace {

constexpr double kPushedBack = 5.0;  // freed distances
constexpr double kStanding = 0.5;    // share of the rate: an obstacle may stop it
constexpr double kFlies = 0.5;  // share of its greatest velocity at which it leaves an obstacle
constexpr double kLoadRamp = 500.0;   // per s: what pushes back may be an obstacle, or a blow
constexpr double kLeadRamp = 2000.0;  // per s: what drives it on
constexpr double kLags = 0.9;         // share of its greatest lag: its setpoint waits now and then

}  // namespace

Servo::Servo(const ServoSettings& settings)
    : settings_(settings),
      profile_(settings.max_velocity, settings.max_acceleration),
      pid_(settings.gains) {}

void Servo::start(double position, double velocity, double load) {
  load_ = steady_load_ = load;
  acted_ = -load;
  velocity_ = velocity;
  profile_.start(position, velocity);
  pid_.reset();
  lagged_ = 0.0;
  target_ = position;
  came_to_ = position;
  stalled_ = 0.0;
  blocked_ = false;
  arrived_ = false;
}

double Servo::update(double target, double position, double velocity, double dt, double most) {
  const bool plain = settings_.controller == Controller::kPid;
  if (plain) {
    if (target != target_) pid_.reset();
    profile_.start(target);
  }
  if (target != target_ && blocked_) {                                 // away from the obstacle
    if (steady_load_ * (target - position) > 0.0) steady_load_ = 0.0;  // it may have been that
    load_ = steady_load_;
  }
  target_ = target;
  watch(target, position, velocity, dt);
  if (plain) return pid_.update_plain(target - position, -velocity, dt);
  lag_ = profile_.position() - position;
  lagged_ = std::abs(lag_) > kLags * settings_.max_lag ? lagged_ + dt : 0.0;
  const bool waits = std::abs(lag_) > settings_.max_lag;
  const double led =
      waits ? position + std::copysign(settings_.max_lag, lag_) : profile_.position();
  // It waits for an obstacle ahead of the joint, not on the way back.
  const bool returns = lag_ * (target - led) < 0.0;
  // Behind a joint that has run ahead it has its speed, and brakes it: from rest it would drive it.
  const bool brakes = returns && lag_ * velocity < 0.0;
  if (waits) profile_.start(led, brakes ? velocity : 0.0);
  if (!waits || returns) profile_.advance(target, dt);
  const double error = profile_.position() - position;
  const double error_rate = profile_.velocity() - velocity;
  if (settings_.load_rate == 0.0) return pid_.update(error, error_rate, feed_forward(), dt);
  observe(position, velocity, dt, most);
  const double command = pid_.update(error, error_rate, feed_forward() - load_, dt, false);
  acted_ = std::clamp(command, -most, most);
  return acted_;
}

// The load is the change of its momentum less the last command.
void Servo::observe(double position, double velocity, double dt, double most) {
  // A joint that friction holds trembles: which way it rubs is not known. With all of its friction
  // from one speed on it would creep at that speed.
  const double rubs = settings_.friction * std::clamp(velocity / settings_.arrive_speed, -1.0, 1.0);
  const double expected = (acted_ - settings_.damping * velocity - rubs + load_) * dt;
  const double change = settings_.inertia * (velocity - std::exchange(velocity_, velocity));
  const bool at_rest = std::abs(velocity) < settings_.arrive_speed;
  const double more = (at_rest ? kStanding : 1.0) * settings_.load_rate * (change - expected);
  const double ahead = target_ < position ? -1.0 : 1.0;
  load_ += ahead * std::clamp(ahead * more, -kLoadRamp * dt, kLeadRamp * dt);
  load_ = std::clamp(load_, -most, most);
}

double Servo::feed_forward() const {
  const double v = profile_.velocity();
  const double rubs = v == 0.0 ? 0.0 : std::copysign(settings_.friction, v);
  return settings_.inertia * profile_.acceleration() + settings_.damping * v + rubs;
}

void Servo::free(double position, double velocity) {
  if (settings_.controller == Controller::kProfile) {
    // An obstacle that gives way lets it fly off; a load that it carries by now does not.
    const bool flies = std::abs(velocity) > kFlies * settings_.max_velocity;
    return start(position, velocity, flies ? steady_load_ : load_);
  }
  blocked_ = false;
  came_to_ = position;
  stalled_ = 0.0;
}

void Servo::watch(double target, double position, double velocity, double dt) {
  const double to_go = target - position;
  const double ahead = to_go < 0.0 ? -1.0 : 1.0;
  const bool slow = std::abs(velocity) < settings_.arrive_speed;
  const double near = stalled_ > kNearTime ? settings_.near_error : settings_.arrive_error;
  arrived_ = profile_.at(target) && std::abs(to_go) < near && slow;
  if (blocked_) {
    const double moved = ahead * (position - blocked_at_);
    if (moved > settings_.freed_distance) free(position, velocity);
    if (arrived_) blocked_ = false;
    return;
  }
  // A joint that bounces off an obstacle gets no further; one pushed well back starts again;
  // one that reached its target may swing about it.
  const double progress = ahead * (position - came_to_);
  const bool swings_in = std::abs(to_go) < settings_.freed_distance;
  const bool back = progress < -kPushedBack * settings_.freed_distance;
  const bool comes_on =
      (swings_in ? std::abs(progress) : progress) > settings_.stall_speed * kStallTime || back;
  if (comes_on) {
    came_to_ = position;
    steady_load_ = load_;
  }
  stalled_ = comes_on || arrived_ ? 0.0 : stalled_ + dt;
  if (stalled_ >= kStallTime) {
    blocked_ = true;
    blocked_at_ = position;
  }
}

}  // namespace angen::devices
