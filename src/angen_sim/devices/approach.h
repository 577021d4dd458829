#pragma once

#include <cmath>

namespace angen::devices {

/// A value that approaches a limit exponentially, as the temperature of a heated body.
struct Approach {
  double value = 0.0;
  double limit = 0.0;
  double time_constant = 0.0;  // s; 0 = it is at the limit at once

  void advance(double seconds) {
    value =
        time_constant > 0.0 ? limit + (value - limit) * std::exp(-seconds / time_constant) : limit;
  }
};

}  // namespace angen::devices
