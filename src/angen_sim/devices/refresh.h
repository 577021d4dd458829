#pragma once

#include "core/time.h"

namespace angen::devices {

/// Says, at multiples of a period of simulated time, that what is told of a device may be renewed:
/// a state that changes at every tick is told at this rate.
class Refresh {
 public:
  Refresh() = default;
  /// Rate in Hz, positive.
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
