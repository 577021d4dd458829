#pragma once

#include <embree3/rtcore.h>

#include <cmath>
#include <limits>

#include "core/pose.h"

namespace angen::rays {

// Embree only finds candidates, in floats; ranges are computed in doubles by our own functions.
// Candidates' boxes are padded by more than the float ray can stray from the double one (within
// 4 km of the origin), so none is missed and no answer depends on the order of traversal.

inline RTCBounds padded(const Eigen::AlignedBox3d& box) {
  const auto outward = [](double value, double sign) {
    return static_cast<float>(value + sign * (5e-4 + 1e-6 * std::abs(value)));
  };
  RTCBounds out{};
  if (box.isEmpty() || !box.min().allFinite() || !box.max().allFinite()) {
    // Embree skips a primitive with an inverted box.
    out.lower_x = out.lower_y = out.lower_z = std::numeric_limits<float>::infinity();
    out.upper_x = out.upper_y = out.upper_z = -std::numeric_limits<float>::infinity();
    return out;
  }
  out.lower_x = outward(box.min().x(), -1);
  out.lower_y = outward(box.min().y(), -1);
  out.lower_z = outward(box.min().z(), -1);
  out.upper_x = outward(box.max().x(), 1);
  out.upper_y = outward(box.max().y(), 1);
  out.upper_z = outward(box.max().z(), 1);
  return out;
}

/// A float at or beyond a range, so that a tie is still visited.
inline float reach(double range) { return static_cast<float>(range) * 1.000001F; }

inline void aim(RTCRay& ray, const Vec3& origin, const Vec3& direction, double min, double max) {
  ray.org_x = static_cast<float>(origin.x());
  ray.org_y = static_cast<float>(origin.y());
  ray.org_z = static_cast<float>(origin.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = static_cast<float>(min) * 0.999999F;
  ray.tfar = reach(max);
  ray.time = 0.0F;
  ray.mask = UINT32_MAX;
  ray.id = 0;
  ray.flags = 0;
}

}  // namespace angen::rays
