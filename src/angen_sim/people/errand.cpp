#include "people/errand.h"

#include <algorithm>

#include "people/stroll.h"

namespace angen::people {

namespace {

constexpr double kArrived = 0.03;   // m: nearer than this it is there
constexpr double kCloseBy = 0.22;   // m: so is one that something holds nearer than this
constexpr double kMoved = 0.05;     // m: who was pushed that far stays
constexpr double kNearerBy = 0.05;  // m: less than this is no progress
constexpr double kOnWay = 0.3;      // m: who came that far is no longer held
constexpr double kCircle = 1.5;     // m, radius about a place
constexpr Nanoseconds kLingers = 40 * kSecond;  // longer than crossing the circle

}  // namespace

bool Errand::begin(const Vec2& at, Nanoseconds now) {
  if (std::exchange(begun_, true)) return false;
  circle_ = at;
  entered_at_ = now;
  return true;
}

bool Errand::is_there(const Vec2& at, bool rests, bool held) const {
  const bool stayed = phase_ == Phase::kArrived && rests;
  return away(at) < (stayed ? stays_within_ : held ? kCloseBy : kArrived);
}

void Errand::stop_at(const Vec2& at) { stays_within_ = std::max(kPushedAway, away(at) + kMoved); }

// New plans that come to nothing may follow each other for ever.
bool Errand::lingers(const Vec2& at, Nanoseconds now, bool waits, bool rests, double speed) {
  const bool stays = phase_ == Phase::kArrived && rests;  // until something pushes it away
  if (stays || waits || pushes_ || (at - circle_).norm() > kCircle) {
    circle_ = at;
    entered_at_ = now;
  }
  return now - entered_at_ > kLingers + from_seconds(2.0 * kCircle / speed);
}

bool Errand::come(double left) {
  const bool nearer = least_left_ - left > kNearerBy;
  if (nearer) least_left_ = left;
  return nearer;
}

bool Errand::is_free(double left) const { return left < held_left_ - kOnWay; }

}  // namespace angen::people
