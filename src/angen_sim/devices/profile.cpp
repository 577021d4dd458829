#include "devices/profile.h"

#include <algorithm>
#include <cmath>

namespace angen::devices {

void Profile::start(double position, double velocity) {
  position_ = position;
  velocity_ = velocity;
  acceleration_ = 0.0;
}

void Profile::advance(double target, double dt) {
  const double change = max_acceleration_ * dt;
  const double to_go = target - position_;
  // The last step: one step covers the rest of the way, and may end at rest.
  if (std::abs(velocity_) <= change && std::abs(to_go) <= change * dt) {
    acceleration_ = -velocity_ / dt;
    position_ = target;
    velocity_ = 0.0;
    return;
  }
  // Seen along the way: the fastest next velocity u from which braking still ends at the
  // target, that is (velocity + u) / 2 * dt + u^2 / (2 a) = |to_go|.
  const double sign = to_go < 0.0 ? -1.0 : 1.0;
  const double now = sign * velocity_;
  const double room = std::abs(to_go) - now * dt / 2.0;
  const double root = std::sqrt(dt * dt / 4.0 + 2.0 * std::abs(room) / max_acceleration_);
  double next = max_acceleration_ * (root - dt / 2.0);
  if (room < 0.0) next = -next;
  next = std::clamp(std::min(next, max_velocity_), now - change, now + change);
  acceleration_ = sign * (next - now) / dt;
  position_ += sign * (now + next) / 2.0 * dt;
  velocity_ = sign * next;
}

}  // namespace angen::devices
