#include "rays/nearby.h"

#include <algorithm>

#include "rays/layer.h"

namespace angen::rays {

bool Nearby::blocked(const Vec3& from, const Vec3& to, double margin, Mobilities among) const {
  SceneQuery q;
  if (!q.prepare_between(from, to, margin, among)) return false;
  Intersection found;
  return std::any_of(solids_.begin(), solids_.end(), [&](const Solid* solid) {
    return q.wants(*solid, true) &&
           find_hit(*solid, q.origin, q.direction, q.min, q.best.range, found);
  });
}

bool Nearby::covered(const Vec3& point, std::uint32_t except) const {
  return std::any_of(solids_.begin(), solids_.end(), [&](const Solid* solid) {
    return solid->slot != except && contains(*solid, point);
  });
}

}  // namespace angen::rays
