#pragma once

#include <utility>

#include "core/time.h"
#include "plugin/params.h"

namespace angen::devices {

/// Rates that a Refresh takes, Hz: a period of some nanoseconds at least, and of less than an age.
constexpr Range kRefreshRate{1e-6, 1e6};

/// When the published state of a device is renewed: at multiples of a period of simulated time,
/// also for a state that changes at every tick.
class Refresh {
 public:
  Refresh() = default;
  /// Rate in Hz, in kRefreshRate.
  explicit Refresh(double rate) : period_(from_seconds(1.0 / rate)) {}

  /// Whether a multiple of the period is in the step that ends at `time`; also the first time.
  bool due(Nanoseconds time, Nanoseconds step) {
    const bool first = std::exchange(first_, false);
    return first || time < step || time / period_ != (time - step) / period_;
  }

  /// When it will be due next, after `time`.
  Nanoseconds next(Nanoseconds time) const { return (time / period_ + 1) * period_; }

 private:
  Nanoseconds period_ = kSecond / 50;
  bool first_ = true;
};

}  // namespace angen::devices
