#include "light/paths.h"

#include <array>
#include <cmath>

#include "light/beam.h"
#include "light/directions.h"

namespace angen::light {
namespace {

// SDF's white is 1, which would let light live for ever; white paint reflects no more than this.
constexpr double kLargestAlbedo = 0.9;
constexpr double kMargin = 1e-4;  // m, a surface does not meet its own rays

const double kViewTangent = std::tan(M_PI / 6);              // half of 60 degrees
const double kViewArea = 4 * kViewTangent * kViewTangent;    // on the plane 1 m ahead
const Eigen::Array3d kLuminance = {0.2126, 0.7152, 0.0722};  // Rec. 709

double luminance(const Eigen::Array3d& rgb) { return (kLuminance * rgb).sum(); }

/// Where the view's square image sees a direction of the probe's own frame (x ahead).
bool in_view(const Vec3& local) {
  const double edge = local.x() * kViewTangent;
  return local.x() > 0 && std::abs(local.y()) <= edge && std::abs(local.z()) <= edge;
}

/// The hemisphere's directions in the probe's frame: about x instead of z.
Vec3 first_direction(std::size_t path) {
  const Vec3& about_z = directions()[0][path];
  return {about_z.z(), about_z.x(), about_z.y()};
}

/// By path: cosine-weighted directions as an image plane weighs them, all its points alike.
std::array<double, kPaths> make_view_weights() {
  std::array<double, kPaths> weights{};
  double sum = 0.0;
  for (std::size_t path = 0; path < kPaths; ++path) {
    const Vec3 local = first_direction(path);
    if (in_view(local)) weights[path] = 1.0 / std::pow(local.x(), 4);
    sum += weights[path];
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

const std::array<double, kPaths>& view_weights() {
  static const std::array<double, kPaths> weights = make_view_weights();
  return weights;
}

rays::Ray ray_from(const Vec3& origin, const Vec3& direction) {
  rays::Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.min = kMargin;
  return ray;
}

}  // namespace

Paths::Paths(const rays::Scene& scene, const Pose& pose) : scene_(scene), pose_(pose) { trace(); }

void Paths::trace() {
  std::vector<rays::Ray> rays;
  std::vector<rays::Hit> hits;
  std::vector<Vertex> front(kPaths);
  for (std::size_t path = 0; path < kPaths; ++path) {
    front[path].path = path;
    front[path].throughput = Rgb::Ones();
    rays.push_back(ray_from(pose_.position, pose_.rotation * first_direction(path)));
  }
  Rgb albedos = Rgb::Zero();
  std::size_t casts = 0;
  for (std::size_t bounce = 0; bounce < kBounces; ++bounce) {
    if (bounce > 0) {
      rays.clear();
      for (const Vertex& from : front) {
        const Vec3 direction = frame_about(from.normal) * directions()[bounce][from.path];
        rays.push_back(ray_from(from.position, direction.normalized()));
      }
      casts += rays.size();
    }
    scene_.cast(rays, hits);
    last_ = vertices_.size();
    if (bounce == 1) second_ = last_;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (!hits[i].hit()) continue;
      const Rgb albedo =
          scene_.reflectance(hits[i].shape).cast<double>().array().max(0.0).min(kLargestAlbedo);
      if (bounce > 0) albedos += albedo;
      vertices_.push_back({rays[i].origin + hits[i].range * rays[i].direction,
                           hits[i].normal.cast<double>().normalized(), front[i].throughput * albedo,
                           front[i].path});
    }
    front.assign(vertices_.begin() + static_cast<std::ptrdiff_t>(last_), vertices_.end());
  }
  if (casts > 0) mean_albedo_ = albedos / static_cast<double>(casts);
}

Paths::Direct Paths::direct(const Lamp& lamp) const {
  const Beam from_lamp = beam(lamp, pose_.position);
  const Vec3 local = pose_.rotation.conjugate() * from_lamp.towards;
  if (local.x() <= 0.0 || from_lamp.illuminance <= 0.0) return {};
  const double arriving =
      from_lamp.illuminance * visible_share(scene_, lamp, from_lamp, pose_.position);
  Direct out;
  out.illuminance = arriving * local.x();
  // The lamp's disc covers (1 / x^3) of its solid angle on the image plane: what it sends is the
  // same whatever its size.
  if (lamp.type != Lamp::Type::kDirectional && in_view(local)) {
    out.radiance = arriving / (std::pow(local.x(), 3) * kViewArea);
  }
  return out;
}

double Paths::arriving(const Lamp& lamp, const Vertex& vertex, std::size_t index) const {
  const Beam from_lamp = beam(lamp, vertex.position);
  const double cosine = vertex.normal.dot(from_lamp.towards);
  if (cosine <= 0.0 || from_lamp.illuminance <= 0.0) return 0.0;
  if (!sees_one(scene_, lamp, from_lamp, vertex.position, index)) return 0.0;
  return from_lamp.illuminance * cosine;
}

Transport Paths::transport(LampId id, const Lamp& lamp) const {
  // Each path brings luminance from its direction: the throughputs times what its surfaces receive.
  Rgb hemisphere = Rgb::Zero(), view = Rgb::Zero();
  const auto bring = [&](const Vertex& vertex, const Rgb& received) {
    hemisphere += vertex.throughput * received / kPaths;
    view += vertex.throughput * received * (view_weights()[vertex.path] / M_PI);
  };
  double beyond_first = 0.0;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const double received = arriving(lamp, vertices_[i], i);
    if (i >= second_) beyond_first += received;
    if (received > 0.0) bring(vertices_[i], Rgb::Constant(received));
  }
  // The bounces left out, as if the rest of the way led through surfaces like those already met.
  if (beyond_first > 0.0) {
    const double mean = beyond_first / static_cast<double>(vertices_.size() - second_);
    const Rgb rest = mean * mean_albedo_ / (1.0 - mean_albedo_);
    for (std::size_t i = last_; i < vertices_.size(); ++i) bring(vertices_[i], rest);
  }
  const Direct own = direct(lamp);
  const Rgb color = lamp.color.cast<double>().array();
  Transport out;
  out.lamp = id;
  out.illuminance = luminance(color * (own.illuminance + hemisphere));
  out.radiance = (color * (own.radiance + view)).cast<float>().matrix();
  return out;
}

}  // namespace angen::light
