#pragma once

#include "core/time.h"

namespace angen {

/// CPU time of the thread that uses it, in laps. A lap costs one reading of the monotonic clock,
/// some 25 ns; only one so long that the thread may have been away in it is compared with the
/// thread's CPU clock, which costs a system call. For measuring costs: nothing that it
/// measures may affect the world.
class Stopwatch {
 public:
  struct Clocks {
    Nanoseconds (*wall)();  // monotonic
    Nanoseconds (*cpu)();   // this thread's CPU time
  };
  static Clocks system_clocks();

  explicit Stopwatch(Clocks clocks = system_clocks()) : clocks_(clocks) {}

  /// Begins a lap, or with `running` false none: laps take no time until the next start.
  void start(bool running) {
    running_ = running;
    if (!running) return;
    const Nanoseconds now = clocks_.wall();
    if (now - last_ > kSuspect) compare(now);
    last_ = now;
  }

  /// CPU time (ns) since the lap began; begins the next.
  Nanoseconds lap() {
    if (!running_) return 0;
    const Nanoseconds now = clocks_.wall();
    Nanoseconds spent = now - last_;
    if (spent > kSuspect) spent = without_absence(spent, now);
    last_ = now;
    return spent;
  }

 private:
  static constexpr Nanoseconds kSuspect = 50'000;

  void compare(Nanoseconds now) {
    wall_then_ = now;
    cpu_then_ = clocks_.cpu();
  }
  Nanoseconds without_absence(Nanoseconds spent, Nanoseconds now);

  Clocks clocks_;
  bool running_ = false;
  Nanoseconds last_ = 0;
  Nanoseconds wall_then_ = 0;  // when both clocks were last read
  Nanoseconds cpu_then_ = 0;
};

}  // namespace angen
