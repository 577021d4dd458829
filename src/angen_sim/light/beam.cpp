#include "light/beam.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "light/directions.h"

namespace angen::light {
namespace {

constexpr double kFar = 1e4;  // m, as far as anything can stand before a directional lamp

/// Candela along `away` (unit, from the lamp). A spot's flux is spread evenly over its inner cone
/// and falls off linearly in the cosine to its outer one; SDF gives both cones' full angles.
double intensity(const Lamp& lamp, const Vec3& away) {
  if (lamp.type == Lamp::Type::kPoint) return lamp.luminous_flux / (4.0 * M_PI);
  const double outer = std::cos(std::min(lamp.outer_angle, 2.0 * M_PI) / 2.0);
  const double inner =
      std::max(outer, std::cos(std::min(lamp.inner_angle, lamp.outer_angle) / 2.0));
  const double cosine = away.dot(lamp.pose.rotation * lamp.direction);
  if (cosine <= outer) return 0.0;
  const double share = cosine >= inner ? 1.0 : (cosine - outer) / (inner - outer);
  return share * lamp.luminous_flux / (2.0 * M_PI * (1.0 - (inner + outer) / 2.0));
}

bool sees(const rays::Scene& scene, const Lamp& lamp, const Beam& beam, const Vec3& point,
          const Vec3& on_sphere) {
  if (lamp.type == Lamp::Type::kDirectional) {
    return !scene.blocked(point, point + kFar * beam.towards);
  }
  return !scene.blocked(point, lamp.pose.position + lamp.radius * on_sphere);
}

}  // namespace

Beam beam(const Lamp& lamp, const Vec3& point) {
  Beam out;
  if (lamp.type == Lamp::Type::kDirectional) {
    out.towards = -(lamp.pose.rotation * lamp.direction);
    out.distance = std::numeric_limits<double>::infinity();
    out.illuminance = lamp.luminous_flux;
    return out;
  }
  const Vec3 offset = lamp.pose.position - point;
  out.distance = offset.norm();
  if (out.distance < 1e-9) return out;
  out.towards = offset / out.distance;
  const double clamped = std::max(out.distance, lamp.radius);
  out.illuminance = intensity(lamp, -out.towards) / (clamped * clamped);
  return out;
}

double visible_share(const rays::Scene& scene, const Lamp& lamp, const Beam& beam,
                     const Vec3& point) {
  if (!lamp.cast_shadows) return 1.0;
  if (lamp.type == Lamp::Type::kDirectional)
    return sees(scene, lamp, beam, point, Vec3::Zero()) ? 1.0 : 0.0;
  int free = 0, seen = 0;
  for (const Vec3& on_sphere : lamp_points()) {
    // A ceiling that the sphere dips into takes none of its light.
    const Vec3 surface = lamp.pose.position + lamp.radius * on_sphere;
    if (scene.blocked(lamp.pose.position, surface, 0.0)) continue;
    ++free;
    if (sees(scene, lamp, beam, point, on_sphere)) ++seen;
  }
  return free == 0 ? 0.0 : static_cast<double>(seen) / free;
}

bool sees_one(const rays::Scene& scene, const Lamp& lamp, const Beam& beam, const Vec3& point,
              std::size_t which) {
  return !lamp.cast_shadows || sees(scene, lamp, beam, point, lamp_points()[which % kLampPoints]);
}

}  // namespace angen::light
