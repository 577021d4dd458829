#pragma once

#include <cmath>

#include "core/pose.h"

namespace angen::rays {

/// Intersects the line of a ray with the triangle from both sides; false without a hit. Plücker's
/// test: neighbors compute bit-equal opposites for a shared edge, so no ray passes between them.
inline bool intersect_triangle(const Vec3& corner0, const Vec3& corner1, const Vec3& corner2,
                               const Vec3& origin, const Vec3& direction, double& range) {
  const Vec3 a = corner0 - origin, b = corner1 - origin, c = corner2 - origin;
  const Vec3 ca = c - a, ab = a - b, bc = b - c;
  const double u = ca.cross(c + a).dot(direction);
  const double v = ab.cross(a + b).dot(direction);
  const double w = bc.cross(b + c).dot(direction);
  const bool front = u >= 0 && v >= 0 && w >= 0;
  const bool back = u <= 0 && v <= 0 && w <= 0;
  if (!front && !back) return false;
  const Vec3 normal = ab.cross(ca);
  const double along = normal.dot(direction);
  if (along == 0.0) return false;
  range = normal.dot(a) / along;
  return std::isfinite(range);
}

}  // namespace angen::rays
