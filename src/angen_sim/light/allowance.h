#pragma once

#include <algorithm>
#include <cstdint>

#include "core/time.h"

namespace angen::light {

/// A token bucket of rays for light: simulated time fills it up to a limit, however often it is
/// asked.
class Allowance {
 public:
  /// `per_ray`: simulated ns that earn one ray; `most`: capacity in rays, full at first.
  constexpr Allowance(Nanoseconds per_ray, std::int64_t most)
      : per_ray_(per_ray), most_(most * per_ray), saved_(most_) {}

  void pass_to(Nanoseconds now) {
    saved_ = std::min(most_, saved_ + std::max<Nanoseconds>(0, now - now_));
    now_ = now;
  }
  /// Rays; 0 or less until time has paid for an overdraft.
  std::int64_t left() const { return saved_ / per_ray_; }
  void spend(std::int64_t rays) { saved_ -= rays * per_ray_; }

 private:
  Nanoseconds per_ray_;
  Nanoseconds most_;
  Nanoseconds saved_;
  Nanoseconds now_ = 0;
};

}  // namespace angen::light
