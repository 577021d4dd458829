#include "people/stroll.h"

namespace angen::people {

namespace {

constexpr Nanoseconds kFreed = kSecond;  // time by which it comes on after it was held
constexpr Nanoseconds kBackStep = kSecond / 20;
constexpr int kMaxBackSteps = 200;

}  // namespace

void Stroll::stay_at(const Pose& pose) {
  path_ = Path({{0, pose.position.x(), pose.position.y(), yaw_of(pose.rotation)}}, false);
}

Stroll::Vec2 Stroll::place_in(Nanoseconds time) const {
  const Path::Place place = in(time);
  return {place.x, place.y};
}

Nanoseconds Stroll::still_for() const {
  const Nanoseconds leaves = path_.still_until(clock_);
  return leaves == kForever ? kForever : leaves - clock_;
}

Stroll::Vec2 Stroll::back_from(const Vec2& at, double away) const {
  Vec2 back = at;
  for (int i = 0; i < kMaxBackSteps; ++i) {
    back = place_in(-i * kBackStep);
    if ((back - at).norm() >= away) break;
  }
  return back;
}

bool Stroll::is_free() const { return clock_ > held_at_ + kFreed; }

}  // namespace angen::people
