#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/time.h"
#include "ros/pacer.h"

namespace angen::node {

inline double seconds(Pacer::Clock::duration d) { return std::chrono::duration<double>(d).count(); }

/// The times of what is published once a second of wall time.
class WallSeconds {
 public:
  /// After a second: the simulated seconds a wall second since the last one, at least 0.
  std::optional<double> end(Nanoseconds time, Pacer::Clock::time_point now) {
    if (now - begun_ < kWallSecond) return std::nullopt;
    const double factor = to_seconds(time - time_) / seconds(now - begun_);
    begun_ = now;
    time_ = time;
    return std::max(0.0, factor);
  }

 private:
  Pacer::Clock::time_point begun_ = Pacer::Clock::now();
  Nanoseconds time_ = 0;
};

}  // namespace angen::node
