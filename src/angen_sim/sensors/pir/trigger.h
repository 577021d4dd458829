#pragma once

#include "core/time.h"
#include "plugin/params.h"

namespace angen::sensors {

/// When a detector's output is on, from when its comparator fires.
class Trigger {
 public:
  struct Times {
    Nanoseconds hold = 0;     // duration of its output
    Nanoseconds lockout = 0;  // then it ignores the comparator
    Nanoseconds warm_up = 0;  // and after the start
    bool retrigger = true;    // whether each firing restarts the hold
  };

  Trigger() = default;
  Trigger(const Times& times, Nanoseconds start)
      : times_(times), ignored_until_(start + times.warm_up) {}

  /// Whether the output is on at `now`.
  bool step(Nanoseconds now, bool fires) {
    if (on_ && now >= off_at_ && !(fires && times_.retrigger)) {
      on_ = false;
      ignored_until_ = off_at_ + times_.lockout;
    }
    if (!fires || now < ignored_until_ || (on_ && !times_.retrigger)) return on_;
    on_ = true;
    off_at_ = now + times_.hold;
    return true;
  }

  bool on() const { return on_; }
  /// The time at which the output turns off, unless the comparator fires before; kForever while it
  /// is off.
  Nanoseconds off_at() const { return on_ ? off_at_ : kForever; }

 private:
  Times times_;
  Nanoseconds ignored_until_ = 0;
  Nanoseconds off_at_ = 0;
  bool on_ = false;
};

/// Reads <hold_time>, <lockout_time>, <warm_up> and <retrigger>; `fallback` has the values that are
/// not given.
Trigger::Times read_times(Params& params, const Trigger::Times& fallback);

}  // namespace angen::sensors
