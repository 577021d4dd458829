#pragma once

#include "core/time.h"
#include "people/surroundings.h"

namespace angen::people {

/// Whether a person comes on, and for how long it has not. Something holds it from a second without
/// coming on until it has come on for some way.
class Progress {
 public:
  using Vec2 = Surroundings::Vec2;

  /// A person waits for a free way: it steps back, then looks again and again.
  struct Wait {
    Nanoseconds since = 0;
    Nanoseconds away_until = 0;   // end of stepping back
    Nanoseconds retry_at = 0;     // from then on it goes on if it sees a free way …
    Nanoseconds blind_at = 0;     // … and from then on in any case
    Nanoseconds checked_at = -1;  // time of the last look, in whole seconds
    Vec2 back_to = Vec2::Zero();  // m
  };

  /// Another goal, or none.
  void reset() {
    stalled_ = 0;
    held_ = false;
    tries_ = errors_ = 0;
  }
  /// It counts from here how far it comes.
  void count_from(const Vec2& at) { came_to_ = at; }
  /// It comes on, by walking or by a step at a door.
  void come(const Vec2& at, Nanoseconds now);
  void restart(Nanoseconds now) { best_at_ = now; }
  void rest() { stalled_ = 0; }
  /// Goes on after waiting, on a way that may be none.
  void resume(const Vec2& at, Nanoseconds now);
  void err() { ++errors_; }

  struct Step {
    bool best = false;   // it is nearer to its goal than at any time before
    bool comes = false;  // it comes on
    bool round = false;  // it is on a way round something
  };
  /// A step of walking. Returns whether it has stalled.
  bool note(const Vec2& at, const Step& step, Nanoseconds now, Nanoseconds time);

  bool is_held() const { return held_; }
  void hold() { held_ = true; }
  void free() { held_ = false; }
  /// It has stalled for so long that it makes room.
  bool must_make_room() const;
  /// Begins a wait; each of several is longer.
  Wait wait(Nanoseconds now);
  double nearer_by(const Vec2& at, const Vec2& goal) const {
    return (goal - came_to_).norm() - (goal - at).norm();
  }

 private:
  Nanoseconds stalled_ = 0;      // since it last came on
  Vec2 came_to_ = Vec2::Zero();  // where that was
  bool held_ = false;
  Nanoseconds best_at_ = 0;     // when it last was nearer to its goal than ever
  Nanoseconds resumed_at_ = 0;  // when it last went on after waiting
  int tries_ = 0;               // waits, while it is held
  int errors_ = 0;              // free ways that were none, while it is held
};

}  // namespace angen::people
