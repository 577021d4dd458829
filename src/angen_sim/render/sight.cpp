#include "render/sight.h"

namespace angen::render {
namespace {

// The last level on which faces are searched for again where the level above had too many.
constexpr std::size_t kLastSearch = 1;

}  // namespace

Hull Sights::hull_of(std::size_t lamp, const Box& points) const {
  const Eigen::Vector3f position = lamps_[lamp].lamp.pose.position.cast<float>();
  return {Box(position), points};
}

/// Whether the first face on the way from one point to the other hides the lamp.
bool Sights::hides(std::size_t lamp, const Hull& rays, const Eigen::Vector3f& from,
                   const Eigen::Vector3f& to, bool& is_free) {
  Face face;
  is_free = !instances_.find_face(from, to, face);
  if (is_free || face.count == 0 || !rays.is_cut_by(face)) return false;
  last_[lamp] = face;
  return true;
}

Sight Sights::of(std::size_t lamp, std::size_t level, const Box& points) {
  Obstacles& own = obstacles_[level];
  if (level == 0) return found(lamp, points, own);
  const Obstacles& above = obstacles_[level - 1];
  if (level <= kLastSearch && !above.unknown.none()) return found(lamp, points, own);
  if (above.unknown.fixed && above.unknown.movers) {
    own.faces.count = 0;
    own.unknown = above.unknown;
    return Sight::kSome;
  }
  return narrowed(hull_of(lamp, points), above, own);
}

Sight Sights::found(std::size_t lamp, const Box& points, Obstacles& obstacles) {
  const light::Lamp& at = lamps_[lamp].lamp;
  obstacles.faces.count = 0;
  obstacles.unknown = {true, true};
  if (at.type == light::Lamp::Type::kDirectional) return Sight::kSome;
  if (!at.cast_shadows) return Sight::kAll;
  const Hull rays = hull_of(lamp, points);
  if (last_[lamp].count > 0 && rays.is_cut_by(last_[lamp])) return Sight::kNone;
  const Eigen::Vector3f position = at.pose.position.cast<float>();
  bool is_free = false;
  if (hides(lamp, rays, points.center(), position, is_free)) return Sight::kNone;
  if (!is_free && hides(lamp, rays, position, points.center(), is_free)) return Sight::kNone;
  instances_.find_in(rays, obstacles);
  return obstacles.unknown.none() && obstacles.faces.count == 0 ? Sight::kAll : Sight::kSome;
}

Sight Sights::narrowed(const Hull& rays, const Obstacles& from, Obstacles& obstacles) const {
  Faces& faces = obstacles.faces;
  faces.count = 0;
  for (std::size_t i = 0; i < from.faces.count; ++i) {
    const Face& face = from.faces.all[i];
    if (!rays.overlaps(face)) continue;
    if (rays.is_cut_by(face)) return Sight::kNone;
    faces.all[faces.count++] = face;
  }
  obstacles.unknown = from.unknown;
  return obstacles.unknown.none() && faces.count == 0 ? Sight::kAll : Sight::kSome;
}

}  // namespace angen::render
