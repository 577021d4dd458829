#include "render/sight.h"

#include "render/shade.h"

namespace angen::render {

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
  if (at.type == light::Lamp::Type::kDirectional) return Sight::kSome;
  if (!at.cast_shadows) return Sight::kAll;
  const Eigen::Vector3f position = at.pose.position.cast<float>();
  // A lifted ray ends beside the lamp by as much.
  const Hull rays(Box(position.array() - kLift, position.array() + kLift), points);
  if (last_[lamp].count > 0 && rays.is_cut_by(last_[lamp])) return Sight::kNone;
  bool is_free = false;
  if (hides(lamp, rays, points.center(), position, is_free)) return Sight::kNone;
  if (is_free) return instances_.any_in(rays) ? Sight::kSome : Sight::kAll;
  return hides(lamp, rays, position, points.center(), is_free) ? Sight::kNone : Sight::kSome;
}

}  // namespace angen::render
