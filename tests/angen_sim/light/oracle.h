#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/random.h"
#include "light/beam.h"
#include "light/directions.h"
#include "light/field.h"
#include "light/lamp.h"
#include "light/shadow.h"

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

/// Random walks from one place, with one of the lit lamps sampled at each vertex by its light
/// there.
class Tracer {
 public:
  Tracer(const rays::Scene& scene, std::vector<Lit> lit, const Pose& pose, std::uint64_t seed)
      : scene_(scene), lit_(std::move(lit)), pose_(pose), rng_(seed, hash_bytes("oracle"), 0) {}

  void run(int paths) {
    for (int i = 0; i < paths; ++i) {
      const double value = walk();
      sum_ += value;
      squares_ += value * value;
    }
    paths_ += paths;
  }
  int paths() const { return paths_; }
  double mean() const { return sum_ / paths_; }  // lx
  double deviation() const {                     // lx, of the mean
    return std::sqrt(std::max(0.0, squares_ / paths_ - mean() * mean()) / paths_);
  }

 private:
  Rgb from(const Vec3& point, const Vec3& normal) {
    std::vector<double> free;
    double all = 0.0;
    for (const Lit& each : lit_) {
      free.push_back(each.level * illuminance(each.lamp, point, normal));
      all += free.back();
    }
    if (!(all > 0.0)) return Rgb::Zero();
    std::size_t which = 0;
    if (lit_.size() > 1) {
      double left = rng_.uniform() * all;
      while (which + 1 < lit_.size() && (left -= free[which]) >= 0.0) ++which;
    }
    const Lamp& lamp = lit_[which].lamp;
    Rgb color = Rgb::Zero();
    color.head<3>() = lamp.color.array();
    const double share = free[which] > 0.0 ? lit_[which].level * all / free[which] : 0.0;
    return static_cast<float>(share * arriving(scene_, lamp, point, normal, rng_)) * color;
  }

  double walk() {
    Vec3 point = pose_.position, normal = pose_.rotation * Vec3::UnitX();
    Rgb through{0.2126F, 0.7152F, 0.0722F, 0.0F};  // Rec. 709
    double value = 0.0;
    for (;;) {
      value += (through * from(point, normal)).sum();
      rays::Ray ray;
      ray.origin = point;
      const double u = rng_.uniform(), v = rng_.uniform();
      ray.direction = (frame_about(normal) * cosine_direction(u, v)).normalized();
      ray.min = 1e-4;
      rays::Hit hit;
      scene_.cast(&ray, &hit, 1);
      if (!hit.hit()) return value;
      // Russian roulette: the walk continues with the albedo's probability.
      const Rgb next = through * albedo(scene_, hit.shape);
      const float lasts = next.sum() / through.sum();
      if (rng_.uniform() >= lasts) return value;
      through = next / lasts;
      point = ray.origin + hit.range * ray.direction;
      normal = hit.normal.cast<double>().normalized();
    }
  }

  const rays::Scene& scene_;
  std::vector<Lit> lit_;
  Pose pose_;
  Rng rng_;
  int paths_ = 0;
  double sum_ = 0.0, squares_ = 0.0;
};

/// lx at `pose` from one lamp.
inline Traced trace(const rays::Scene& scene, const Lamp& lamp, const Pose& pose, int paths) {
  Tracer tracer(scene, {{lamp, 1.0}}, pose, 7);
  tracer.run(paths);
  return {tracer.mean(), tracer.deviation()};
}

}  // namespace angen::light::testing
