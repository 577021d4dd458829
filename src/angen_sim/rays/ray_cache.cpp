#include "rays/ray_cache.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rays/query.h"

namespace angen::rays {

namespace {

constexpr int kLanes = 4;
constexpr double kMargin = 1e-6;         // m, more than a hit's place may be off by rounding
constexpr float kMinDirection = 1e-12F;  // less counts as this: keeps 0 * inf out of slab tests

float inverse(double direction) {
  const auto d = static_cast<float>(direction);
  return 1.0F / (std::abs(d) < kMinDirection ? std::copysign(kMinDirection, d) : d);
}

bool usable(const Ray& ray) {
  return ray.origin.cast<float>().allFinite() && ray.direction.cast<float>().allFinite() &&
         ray.min <= ray.max;
}

}  // namespace

RayCache::RayCache(std::vector<Ray> rays, const Scene& scene) : rays_(std::move(rays)) {
  measure(scene);
}

void RayCache::measure(const Scene& scene) {
  fixed_.resize(rays_.size());
  scene.cast(rays_.data(), fixed_.data(), rays_.size(), only(Mobility::kStatic));
  reach_.setEmpty();
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const Ray& ray = rays_[i];
    if (!usable(ray)) continue;
    const double range = std::min(fixed_[i].range, ray.max);
    if (!std::isfinite(range)) {
      const Vec3 corner = Vec3::Constant(std::numeric_limits<double>::infinity());
      reach_ = Eigen::AlignedBox3d(-corner, corner);
      break;
    }
    reach_.extend(ray.origin);
    reach_.extend(ray.origin + range * ray.direction);
  }
  if (!reach_.isEmpty()) {
    reach_.min().array() -= kMargin;
    reach_.max().array() += kMargin;
  }
  settled_.clear();
  pack();
  clip(fixed_);
}

void RayCache::settle(const Scene& scene, const std::vector<ShapeId>& movers) {
  settled_ = fixed_;
  clip(fixed_);
  if (cast_against(scene, movers, settled_.data())) {
    clip(settled_);
  } else {
    settled_ = {};
  }
}

void RayCache::pack() {
  packets_.assign((rays_.size() + kLanes - 1) / kLanes, Packet{});
  for (std::size_t i = 0; i < packets_.size() * kLanes; ++i) {
    Packet& packet = packets_[i / kLanes];
    const auto lane = static_cast<Eigen::Index>(i % kLanes);
    const bool used = i < rays_.size() && usable(rays_[i]);
    for (int axis = 0; axis < 3; ++axis) {
      packet.origin[axis][lane] = used ? static_cast<float>(rays_[i].origin[axis]) : 0.0F;
      packet.inverse[axis][lane] = used ? inverse(rays_[i].direction[axis]) : 1.0F;
    }
    packet.range[lane] = -1.0F;
  }
}

/// Limits the rays of the packets to these hits.
void RayCache::clip(const std::vector<Hit>& hits) {
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    if (!usable(rays_[i])) continue;
    packets_[i / kLanes].range[static_cast<Eigen::Index>(i % kLanes)] =
        rays::reach(std::min(hits[i].range, rays_[i].max));
  }
}

bool RayCache::cast(const Scene& scene, const std::vector<ShapeId>& movers, Hit* hits) const {
  const std::vector<Hit>& known = settled_.empty() ? fixed_ : settled_;
  std::copy(known.begin(), known.end(), hits);
  return cast_against(scene, movers, hits);
}

bool RayCache::cast_against(const Scene& scene, const std::vector<ShapeId>& movers,
                            Hit* hits) const {
  bool hit = false;
  for (const ShapeId mover : movers) {
    const Eigen::AlignedBox3d box = scene.bounds(mover);
    if (reach_.intersects(box)) hit = cast_mover(scene, mover, box, hits) || hit;
  }
  return hit;
}

// Slab test (Kay and Kajiya 1986), on boxes padded as for Embree.
bool RayCache::cast_mover(const Scene& scene, ShapeId mover, const Eigen::AlignedBox3d& box,
                          Hit* hits) const {
  bool hit = false;
  const RTCBounds slab = padded(box);
  const float low[3] = {slab.lower_x, slab.lower_y, slab.lower_z};
  const float high[3] = {slab.upper_x, slab.upper_y, slab.upper_z};
  for (std::size_t p = 0; p < packets_.size(); ++p) {
    const Packet& packet = packets_[p];
    Eigen::Array4f in = Eigen::Array4f::Zero();
    Eigen::Array4f out = packet.range;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Array4f a = (low[axis] - packet.origin[axis]) * packet.inverse[axis];
      const Eigen::Array4f b = (high[axis] - packet.origin[axis]) * packet.inverse[axis];
      in = in.max(a.min(b));
      out = out.min(a.max(b));
    }
    if ((in > out).all()) continue;
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = p * kLanes + static_cast<std::size_t>(lane);
      if (in[lane] > out[lane] || i >= rays_.size()) continue;
      const std::uint32_t before = hits[i].shape;
      scene.better(mover, rays_[i], hits[i]);
      hit = hit || hits[i].shape != before;
    }
  }
  return hit;
}

}  // namespace angen::rays
