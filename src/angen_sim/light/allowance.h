#pragma once

#include <algorithm>
#include <cstdint>

#include "core/time.h"

namespace angen::light {

/// Rays that may be spent on light: so many each second of simulated time, and what is not spent
/// is kept up to a limit. How often it is asked makes no difference.
class Allowance {
 public:
  /// `per_ray`: time in which one more may be spent; `most`: rays that are kept, and there at
  /// first.
  constexpr Allowance(Nanoseconds per_ray, std::int64_t most)
      : per_ray_(per_ray), most_(most * per_ray), saved_(most_) {}

  void pass_to(Nanoseconds now) {
    saved_ = std::min(most_, saved_ + std::max<Nanoseconds>(0, now - now_));
    now_ = now;
  }
  /// Rays; none or less where what was spent last is not paid for yet.
  std::int64_t left() const { return saved_ / per_ray_; }
  void spend(std::int64_t rays) { saved_ -= rays * per_ray_; }

 private:
  Nanoseconds per_ray_;
  Nanoseconds most_;
  Nanoseconds saved_;
  Nanoseconds now_ = 0;
};

}  // namespace angen::light
