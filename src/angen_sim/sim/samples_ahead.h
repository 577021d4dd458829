#pragma once

#include <algorithm>
#include <cstdint>

#include "plugin/plugin.h"
#include "sim/schedule.h"

namespace angen::sim {

/// The coming noise of a sensor, as far as it is known.
struct KnownNoise {
  double quiet = -1.0;    // see Ahead::first_loud()
  Nanoseconds until = 0;  // samples before it are quiet …
  bool loud = false;      // … and the one at it is not
};

/// The samples of one sensor after a time, whose noise is known some seconds ahead.
class SamplesAhead : public Ahead {
 public:
  /// Noise is known at most this far ahead: then it is to be queried again.
  static constexpr Nanoseconds kFarthest = 10 * kSecond;

  SamplesAhead(int unchanged, const Schedule& schedule, Nanoseconds after, std::uint64_t seed,
               std::uint64_t key, KnownNoise& known)
      : unchanged_(unchanged),
        schedule_(schedule),
        after_(after),
        seed_(seed),
        key_(key),
        known_(known) {}

  int unchanged() const override { return unchanged_; }

  /// At the farthest, the first sample whose noise is not known yet.
  Nanoseconds first_loud(double quiet) const override {
    if (quiet >= 1.0) return kForever;
    if (known_.quiet != quiet) known_ = {quiet, 0, false};
    if (known_.loud && known_.until > after_) return known_.until;
    const Nanoseconds end = (after_ / kFarthest + 1) * kFarthest;
    Nanoseconds due = schedule_.next(std::max(after_, known_.until - schedule_.step));
    for (known_.loud = false; !known_.loud; due += schedule_.sample) {
      known_.until = schedule_.tick_of(due);
      if (known_.until > end) break;
      known_.loud = Rng(seed_, key_, known_.until / schedule_.step).uniform() >= quiet;
    }
    return known_.until;
  }

 private:
  int unchanged_;
  const Schedule& schedule_;
  Nanoseconds after_;
  std::uint64_t seed_;
  std::uint64_t key_;
  KnownNoise& known_;
};

}  // namespace angen::sim
