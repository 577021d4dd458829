#include "core/stopwatch.h"

#include <time.h>

#include <algorithm>

namespace angen {
namespace {

Nanoseconds read_clock(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

}  // namespace

Stopwatch::Clocks Stopwatch::system_clocks() {
  return {[] { return read_clock(CLOCK_MONOTONIC); },
          [] { return read_clock(CLOCK_THREAD_CPUTIME_ID); }};
}

// All absence of the thread since the clocks were compared lies in this long lap: the
// others were too short to hold it.
Nanoseconds Stopwatch::without_absence(Nanoseconds spent, Nanoseconds now) {
  const Nanoseconds wall = now - wall_then_;
  const Nanoseconds cpu_before = cpu_then_;
  compare(now);
  return std::clamp<Nanoseconds>(spent - (wall - (cpu_then_ - cpu_before)), 0, spent);
}

}  // namespace angen
