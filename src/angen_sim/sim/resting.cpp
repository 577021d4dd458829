#include "sim/resting.h"

#include <algorithm>
#include <limits>

#include "core/lists.h"

namespace angen::sim {

namespace {

constexpr Nanoseconds kLongEnough = 5 * kSecond;
constexpr double kDisplaced = 2e-4;  // m
constexpr double kTurned = 2e-4;     // half of the angle in rad

bool differs(const Pose& a, const Pose& b) {
  return (a.position - b.position).norm() > kDisplaced ||
         (a.rotation.conjugate() * b.rotation).vec().norm() > kTurned;
}

}  // namespace

Resting::Body Resting::add(const Pose& pose) {
  if (free_.empty()) {
    free_.push_back(static_cast<Body>(bodies_.size()));
    bodies_.emplace_back();
  }
  const Body body = free_.back();
  free_.pop_back();
  bodies_[body].pose = pose;
  return body;
}

void Resting::remove(Body body) {
  bodies_[body] = {};
  free_.push_back(body);
  erase_if(moving_, [&](const auto& each) { return each == body; });
}

bool Resting::move(Body body, const Pose& pose) {
  State& state = bodies_[body];
  if (!differs(state.pose, pose)) return false;
  state.pose = pose;
  state.moved = true;
  if (!state.still) return false;
  state.still = false;
  moving_.push_back(body);
  return true;
}

Nanoseconds Resting::next() const {
  Nanoseconds first = std::numeric_limits<Nanoseconds>::max();
  for (const Body body : moving_) first = std::min(first, bodies_[body].since + kLongEnough);
  return first;
}

bool Resting::come_to_rest(State& state, Nanoseconds now) {
  if (state.moved || now < state.since) state.since = now;
  state.moved = false;
  state.still = now - state.since >= kLongEnough;
  return state.still;
}

}  // namespace angen::sim
