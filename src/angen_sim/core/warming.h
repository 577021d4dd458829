#pragma once

#include <cmath>

#include "core/time.h"

namespace angen {

/// A temperature that approaches its limit exponentially, by Newton's law of cooling.
struct Warming {
  static constexpr double kArrived = 1e-3;  // K from its limit: from then on it is there

  double start = 0.0;          // K, at `since`
  double limit = 0.0;          // K
  double time_constant = 0.0;  // s; 0 = it is at its limit
  Nanoseconds since = 0;

  static Warming constant(double temperature) { return {temperature, temperature, 0.0, 0}; }

  bool operator==(const Warming& o) const {
    return start == o.start && limit == o.limit && time_constant == o.time_constant &&
           since == o.since;
  }

  double at(Nanoseconds time) const {
    if (!(time_constant > 0.0)) return limit;
    const double left = (start - limit) * std::exp(-to_seconds(time - since) / time_constant);
    return std::abs(left) < kArrived ? limit : limit + left;
  }
};

}  // namespace angen
