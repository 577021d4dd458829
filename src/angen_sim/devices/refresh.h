#pragma once

#include <algorithm>
#include <utility>

#include "core/time.h"
#include "plugin/params.h"
#include "plugin/reading.h"

namespace angen::devices {

/// Rates that a Refresh takes, Hz: a period of some nanoseconds at least, and of less than an age.
constexpr Range kRefreshRate{1e-6, 1e6};

/// When a device computes something anew: at multiples of a period of simulated time, also if it
/// changes at every tick.
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

/// When a device renews the state that it publishes: in the ticks that end at multiples of a
/// period, the longest of those of the simulator's reports that is no longer than asked for. So
/// stamps have equal distances, and are of the ticks of their states.
class StateRefresh {
 public:
  StateRefresh() = default;
  /// Rate in Hz, in kRefreshRate.
  explicit StateRefresh(double rate)
      : period_(std::max<Nanoseconds>(1, from_seconds(1.0 / rate) / kReportPeriod) *
                kReportPeriod) {}

  /// Whether to renew in the tick that begins at `time`; also the first time.
  bool due(Nanoseconds time, Nanoseconds step) {
    step_ = step;
    const bool first = std::exchange(first_, false);
    return first || time / period_ != (time + step) / period_;
  }

  /// When it will be due next, after `time`.
  Nanoseconds next(Nanoseconds time) const {
    return ((time + step_) / period_ + 1) * period_ - step_;
  }

 private:
  Nanoseconds period_ = kReportPeriod;
  Nanoseconds step_ = 0;  // the last one
  bool first_ = true;
};

}  // namespace angen::devices
