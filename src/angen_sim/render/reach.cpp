#include "render/reach.h"

#include <cmath>

#include "rays/query.h"

namespace angen::render {
namespace {

constexpr int kRays = 4096;
constexpr float kFar = 1e4F;         // m, range of light outdoors
constexpr float kBeside = 0.3F;      // m: margin for surfaces between two rays
constexpr double kStart = 1e-3;      // m; the lamp may be in a surface
constexpr std::size_t kKnown = 256;  // positions; moving lamps leave old ones

Eigen::AlignedBox3f everywhere() {
  return {Eigen::Vector3f::Constant(-kFar), Eigen::Vector3f::Constant(kFar)};
}

/// Even over the sphere: equal steps in z, each turned by the golden angle.
Eigen::Vector3f direction(int i) {
  const double z = 1.0 - (2.0 * i + 1.0) / kRays;
  const double around = std::sqrt(1.0 - z * z);
  const double angle = M_PI * (3.0 - std::sqrt(5.0)) * i;
  return Vec3(around * std::cos(angle), around * std::sin(angle), z).cast<float>();
}

Eigen::AlignedBox3f reach_from(RTCScene scene, const Vec3& position) {
  const Eigen::Vector3f origin = position.cast<float>();
  Eigen::AlignedBox3f box(origin);
  for (int i = 0; i < kRays; ++i) {
    const Eigen::Vector3f way = direction(i);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    rays::aim(ray.ray, position, way.cast<double>(), kStart, kFar);
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &ray);
    box.extend(origin + ray.ray.tfar * way);
  }
  box.min().array() -= kBeside;
  box.max().array() += kBeside;
  return box;
}

}  // namespace

void Reaches::start(RTCScene scene) {
  scene_ = scene;
  known_.clear();
}

Eigen::AlignedBox3f Reaches::of(const light::Lamp& lamp) {
  if (lamp.type == light::Lamp::Type::kDirectional || !lamp.cast_shadows) return everywhere();
  if (known_.size() > kKnown) known_.clear();
  const Vec3& at = lamp.pose.position;
  const auto [entry, fresh] = known_.try_emplace({at.x(), at.y(), at.z()});
  if (fresh) entry->second = reach_from(scene_, at);
  return entry->second;
}

}  // namespace angen::render
