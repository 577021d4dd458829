#pragma once

#include "core/time.h"
#include "plugin/params.h"

namespace angen::devices {

/// Rates that a Refresh takes, Hz: a period of some nanoseconds at least, and of less than an age.
constexpr Range kRefreshRate{1e-6, 1e6};

/// Says, at multiples of a period of simulated time, that what is told of a device may be renewed:
/// a state that changes at every tick is told at this rate.
class Refresh {
 public:
  Refresh() = default;
  /// Rate in Hz, in kRefreshRate.
  explicit Refresh(double rate) : period_(from_seconds(1.0 / rate)) {}

  bool due(Nanoseconds time) {
    const Nanoseconds count = time / period_;
    if (count == last_) return false;
    last_ = count;
    return true;
  }

 private:
  Nanoseconds period_ = kSecond / 50;
  Nanoseconds last_ = -1;
};

}  // namespace angen::devices
