#pragma once

#include <algorithm>
#include <cstdint>

#include "core/time.h"
#include "plugin/plugin.h"

namespace angen::sim {

/// When a sensor samples and when it publishes: at the first tick at or after start + k * sample,
/// and at the first such sample at or after start + k * publish. In closed form, so that the due
/// times of an idle sensor need not be counted.
struct Schedule {
  Nanoseconds start = 0;  // a multiple of step
  Nanoseconds sample = kSecond;
  Nanoseconds publish = kSecond;
  Nanoseconds step = 1'000'000;

  bool operator==(const Schedule& o) const {
    return start == o.start && sample == o.sample && publish == o.publish && step == o.step;
  }

  /// The first due time after `time`; start itself is due at the first tick after it.
  Nanoseconds next(Nanoseconds time) const {
    return time <= start ? start : start + ((time - start) / sample + 1) * sample;
  }

  /// The tick of the first sample after the tick of `time`.
  Nanoseconds next_sample(Nanoseconds time) const { return tick_of(next(time)); }
  /// The tick that a due time falls on.
  Nanoseconds tick_of(Nanoseconds due) const { return start + up(due - start, step); }

  /// The number of samples before the one at `time` (>= start).
  std::int64_t samples_before(Nanoseconds time) const { return (time - start) / sample; }

  /// The tick of the last sample at or before `time`; before `start` when there was none.
  Nanoseconds last_sample(Nanoseconds time) const {
    if (time < start) return start - step;
    const Nanoseconds count = (time - start) / sample;
    const Nanoseconds at = tick_of(start + count * sample);
    return at <= time ? at : tick_of(start + (count - 1) * sample);
  }

  /// The tick of the last publication at or before `time` (>= start).
  Nanoseconds last_publication(Nanoseconds time) const {
    const Nanoseconds count = (time - start) / publish;
    const Nanoseconds at = sample_for(count * publish);
    if (at <= time) return at;
    if (sample < publish) return sample_for((count - 1) * publish);
    return tick_of(start + (time - start) / sample * sample);
  }

  /// The number of publications at or before `time`, each at its first sample.
  std::int64_t publications(Nanoseconds time) const {
    if (time < start) return 0;
    const Nanoseconds slower = std::max(sample, publish);
    const std::int64_t count = (time - start) / slower;
    return sample_for(count * slower) <= time ? count + 1 : count;
  }

 private:
  static Nanoseconds up(Nanoseconds value, Nanoseconds unit) {
    return (value + unit - 1) / unit * unit;
  }
  Nanoseconds sample_for(Nanoseconds since_start) const {
    return tick_of(start + up(since_start, sample));
  }
};

/// The random numbers of the sample at `time`, and of those before it.
inline Draws draws_at(const Schedule& schedule, Nanoseconds time, std::uint64_t seed,
                      std::uint64_t key) {
  return [=](int samples_ago) {
    Nanoseconds at = time;
    for (int k = 0; k < samples_ago; ++k) at = schedule.last_sample(at - schedule.step);
    return Rng(seed, key, at / schedule.step);
  };
}

}  // namespace angen::sim
