#include "render/sight.h"

#include "render/shade.h"

namespace angen::render {

// A lifted ray ends beside the lamp by as much.
Hull Sights::hull_of(std::size_t lamp, const Box& points) const {
  const Eigen::Vector3f position = lamps_[lamp].lamp.pose.position.cast<float>();
  return {Box(position.array() - kLift, position.array() + kLift), points};
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

Sight Sights::of(std::size_t lamp, const Box& points) {
  const light::Lamp& at = lamps_[lamp].lamp;
  obstacles_.faces.count = 0;
  obstacles_.unknown = {true, true};
  if (at.type == light::Lamp::Type::kDirectional) return Sight::kSome;
  if (!at.cast_shadows) return Sight::kAll;
  const Hull rays = hull_of(lamp, points);
  if (last_[lamp].count > 0 && rays.is_cut_by(last_[lamp])) return Sight::kNone;
  const Eigen::Vector3f position = at.pose.position.cast<float>();
  bool is_free = false;
  if (hides(lamp, rays, points.center(), position, is_free)) return Sight::kNone;
  if (!is_free && hides(lamp, rays, position, points.center(), is_free)) return Sight::kNone;
  instances_.find_in(rays, obstacles_);
  return obstacles_.unknown.none() && obstacles_.faces.count == 0 ? Sight::kAll : Sight::kSome;
}

Sight Sights::of_part(std::size_t lamp, const Box& points) {
  among_ = obstacles_.unknown;
  if (among_.fixed && among_.movers) return Sight::kSome;
  const Faces& faces = obstacles_.faces;
  const Hull rays = hull_of(lamp, points);
  for (std::size_t i = 0; i < faces.count; ++i) {
    if (!rays.overlaps(faces.all[i])) continue;
    if (rays.is_cut_by(faces.all[i])) return Sight::kNone;
    (i < obstacles_.moving ? among_.movers : among_.fixed) = true;
  }
  return among_.none() ? Sight::kAll : Sight::kSome;
}

}  // namespace angen::render
