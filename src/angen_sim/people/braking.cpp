#include "people/braking.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace angen::people {

namespace {

constexpr double kStopShort = 0.08;    // m before an obstacle
constexpr double kDeceleration = 1.0;  // m/s^2
constexpr double kApproaches = 0.3;    // m/s: slower obstacles count as still
constexpr double kSameWay = 0.995;     // cosine of a turn that leaves the free way as it was

}  // namespace

double Braking::limit(const Surroundings& surroundings, const Vec2& at, const Vec2& direction,
                      double speed) {
  const bool turned = along_.dot(direction) < kSameWay;
  if (turned || std::exchange(outdated_, false)) {
    const double expected = free_ - (at - from_).norm();
    free_ = surroundings.free_way(at, direction);
    approach_ = turned ? 0.0 : (expected - free_) / to_seconds(kScanPeriod);
    if (approach_ < kApproaches) approach_ = 0.0;
    from_ = at;
    along_ = direction;
  }
  const double left = std::max(0.0, free_ - (at - from_).norm() - kStopShort);
  const double share = approach_ > 0.0 ? speed / (speed + approach_) : 1.0;
  return std::sqrt(2.0 * kDeceleration * left * share);
}

}  // namespace angen::people
