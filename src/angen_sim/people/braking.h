#pragma once

#include "core/time.h"
#include "people/surroundings.h"

namespace angen::people {

/// A person's surroundings are scanned so often.
constexpr Nanoseconds kScanPeriod = kSecond / 10;

/// The speed at which a person can still stop before an obstacle.
class Braking {
 public:
  using Vec2 = Surroundings::Vec2;

  /// To be called when the surroundings were scanned.
  void invalidate() { outdated_ = true; }
  /// m/s along a unit direction from `at` (m, world), for who walks at `speed`: sqrt(2 a d) at the
  /// distance d to the obstacle, and less where that approaches.
  double limit(const Surroundings& surroundings, const Vec2& at, const Vec2& direction,
               double speed);

 private:
  bool outdated_ = false;
  double approach_ = 0.0;      // m/s, of the obstacle
  double free_ = 0.0;          // m, the free way …
  Vec2 from_ = Vec2::Zero();   // … from here …
  Vec2 along_ = Vec2::Zero();  // … in this direction; zero: not known
};

}  // namespace angen::people
