#pragma once

#include <cmath>

#include "core/random.h"
#include "light/beam.h"
#include "light/directions.h"
#include "light/field.h"
#include "light/shadow.h"
#include "rooms.h"

/// A slow and simple path tracer: random walks, with the lamp sampled at every vertex. It shares
/// only rays and, except for flat lamps, the lamp's direct light with the tested code.
namespace angen::light::testing {

struct Traced {
  double lux = 0.0;
  double deviation = 0.0;  // lx, standard deviation of the mean
};

/// lx from a random point of a flat lamp, as if all its light came from there.
inline double arriving_from_flat(const rays::Scene& scene, const Lamp& lamp, const Vec3& point,
                                 const Vec3& normal, Rng& rng) {
  const Axes axes = axes_of(lamp);
  const double u = rng.uniform(), v = rng.uniform();
  double x = (u - 0.5) * lamp.width, y = (v - 0.5) * lamp.height;
  if (lamp.type == Lamp::Type::kDisc) {
    x = lamp.radius * std::sqrt(u) * std::cos(2.0 * M_PI * v);
    y = lamp.radius * std::sqrt(u) * std::sin(2.0 * M_PI * v);
  }
  const Vec3 on_lamp = lamp.pose.position + x * axes.along + y * axes.across;
  const Vec3 way = on_lamp - point;
  const double leaving = -way.dot(lamp.pose.rotation * lamp.direction), facing = way.dot(normal);
  if (leaving <= 0.0 || facing <= 0.0) return 0.0;
  if (lamp.cast_shadows && scene.blocked(point, on_lamp, 1e-4, rays::kAll)) return 0.0;
  return lamp.luminous_flux / M_PI * leaving * facing / std::pow(way.squaredNorm(), 2);
}

inline double arriving(const rays::Scene& scene, const Lamp& lamp, const Vec3& point,
                       const Vec3& normal, Rng& rng) {
  if (lamp.flat()) {
    const int count = (lamp.pose.position - point).norm() < 1.5 ? 64 : 4;  // near, they vary much
    double sum = 0.0;
    for (int i = 0; i < count; ++i) sum += arriving_from_flat(scene, lamp, point, normal, rng);
    return sum / count;
  }
  const double lux = illuminance(lamp, point, normal);
  const std::size_t which = rng.next() >> 32;
  return lux > 0.0 && sees_one(scene, lamp, point, normal, which, rays::kAll) ? lux : 0.0;
}

inline double walk(const rays::Scene& scene, const Lamp& lamp, const Pose& pose, Rng& rng) {
  Vec3 point = pose.position, normal = pose.rotation * Vec3::UnitX();
  double value = arriving(scene, lamp, point, normal, rng);
  for (;;) {
    rays::Ray ray;
    ray.origin = point;
    const double u = rng.uniform(), v = rng.uniform();
    ray.direction = (frame_about(normal) * cosine_direction(u, v)).normalized();
    ray.min = 1e-4;
    rays::Hit hit;
    scene.cast(&ray, &hit, 1);
    // Russian roulette: the walk continues with the albedo's probability.
    if (!hit.hit() || rng.uniform() >= std::min(kLargestAlbedo, scene.reflectance(hit.shape).y())) {
      return value;
    }
    point = ray.origin + hit.range * ray.direction;
    normal = hit.normal.cast<double>().normalized();
    value += arriving(scene, lamp, point, normal, rng);
  }
}

/// lx at `pose` among gray surfaces from one lamp.
inline Traced trace(const rays::Scene& scene, const Lamp& lamp, const Pose& pose, int paths) {
  Rng rng(7, hash_bytes("oracle"), 0);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < paths; ++i) {
    const double value = walk(scene, lamp, pose, rng);
    sum += value;
    squares += value * value;
  }
  const double mean = sum / paths;
  return {mean, std::sqrt((squares / paths - mean * mean) / paths)};
}

}  // namespace angen::light::testing
