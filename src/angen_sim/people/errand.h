#pragma once

#include <limits>
#include <string>
#include <utility>

#include "core/time.h"
#include "people/surroundings.h"

namespace angen::people {

/// Where a person was sent, and how far it has come.
class Errand {
 public:
  using Vec2 = Surroundings::Vec2;

  enum class Phase { kGoes, kArrived, kGaveUp };

  Errand(const Vec2& to, bool pushes) : to_(to), pushes_(pushes) {}

  const Vec2& to() const { return to_; }
  /// Straight on, against what is in the way.
  bool pushes() const { return pushes_; }
  Phase phase() const { return phase_; }
  bool is_over() const { return phase_ != Phase::kGoes; }
  double away(const Vec2& at) const { return (to_ - at).norm(); }

  /// Begins the first time that it is not there; returns whether this is that time.
  bool begin(const Vec2& at, Nanoseconds now);
  /// Whether it is there; `rests`: it stands, `held`: something holds it.
  bool is_there(const Vec2& at, bool rests, bool held) const;
  void arrive() { phase_ = Phase::kArrived; }
  /// It stands here from now on, unless it is pushed away.
  void stop_at(const Vec2& at);
  void give_up(std::string why) {
    phase_ = Phase::kGaveUp;
    why_ = std::move(why);
  }
  /// Why it gave up; empty if it has not.
  const std::string& why() const { return why_; }
  bool stays(const Vec2& at) const { return phase_ == Phase::kArrived && away(at) < stays_within_; }
  /// Whether it has been in one small circle for too long; not while it `waits` at a door, and not
  /// while it `rests` there. `speed` in m/s.
  bool lingers(const Vec2& at, Nanoseconds now, bool waits, bool rests, double speed);

  /// `left` m of the way are left. Returns whether these are fewer than at any time before.
  bool come(double left);
  /// The way is another one, of that length (m).
  void set_left(double left) { least_left_ = left; }
  void hold_at(double left) { held_left_ = left; }
  /// Whether who was held has come on since.
  bool is_free(double left) const;

 private:
  Vec2 to_;  // m, world
  bool pushes_;
  Phase phase_ = Phase::kGoes;
  std::string why_;
  bool begun_ = false;
  double stays_within_ = 0.1;   // m of the goal, once it has arrived
  Vec2 circle_ = Vec2::Zero();  // middle of the one that it is in
  Nanoseconds entered_at_ = 0;  // when it came into the circle
  double held_left_ = 0.0;      // m of the way, when something began to hold it
  double least_left_ = std::numeric_limits<double>::infinity();  // m
};

}  // namespace angen::people
