#include "people/progress.h"

namespace angen::people {

namespace {

constexpr double kAround = 0.3;  // m: farther than this is progress on a way round
constexpr Nanoseconds kStallTime = kSecond;
constexpr Nanoseconds kTimeout = 3 * kSecond;     // after this time it makes room
constexpr Nanoseconds kStagnates = 10 * kSecond;  // no nearer, and it is held although it moves
constexpr Nanoseconds kAway = 5 * kSecond;        // at least: a door opens in less
constexpr Nanoseconds kFirstBlind = 10 * kSecond;
constexpr int kMaxDoublings = 8;

}  // namespace

void Progress::come(const Vec2& at, Nanoseconds now) {
  stalled_ = 0;
  came_to_ = at;
  best_at_ = now;
}

void Progress::resume(const Vec2& at, Nanoseconds now) {
  resumed_at_ = now;
  stalled_ = 0;
  came_to_ = at;
}

// Nearer to the goal is progress, and the way round something, for a while; along a leaf that one
// leans on is none.
bool Progress::note(const Vec2& at, const Step& step, Nanoseconds now, Nanoseconds time) {
  if (!held_) tries_ = errors_ = 0;
  if (step.best) best_at_ = now;
  if (step.comes || (step.round && (at - came_to_).norm() > kAround)) {
    came_to_ = at;
    stalled_ = 0;
  } else {
    stalled_ += time;
  }
  if (now - std::max(best_at_, resumed_at_) > kStagnates) stalled_ = std::max(stalled_, kTimeout);
  return stalled_ >= kStallTime;
}

bool Progress::must_make_room() const { return stalled_ >= kTimeout; }

Progress::Wait Progress::wait(Nanoseconds now) {
  ++tries_;
  Wait wait;
  wait.since = now;
  wait.away_until = now + kAway;
  wait.retry_at = now + (kAway << std::min(errors_, kMaxDoublings));
  wait.blind_at = now + (kFirstBlind << std::min(tries_, kMaxDoublings));
  return wait;
}

}  // namespace angen::people
