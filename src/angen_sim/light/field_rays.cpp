#include "light/field_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/random.h"
#include "light/beam.h"
#include "light/directions.h"
#include "light/shadow.h"

namespace angen::light {
namespace {

constexpr std::size_t kFans = 32;      // different spreads of a patch's links
constexpr std::uint64_t kSet = 10;     // the best of 16 sets of fans past doors and in gaps
constexpr std::size_t kFirst = 2048;   // rays from any other lamp
constexpr std::size_t kLattice = 128;  // rays from a directional lamp, per side
constexpr double kMargin = 1e-4;       // m, so that a ray does not hit its own surface
constexpr double kFarthest = 1e4;      // m

/// Directions of a patch's links about z, and the site from which each starts.
struct Fan {
  std::vector<Vec3> directions;
  std::vector<std::size_t> sites;
};

Fan make_fan(std::size_t number, std::size_t links) {
  Fan fan;
  Rng rng(kSet, hash_bytes("light links"), static_cast<std::int64_t>(number));
  const double shift_u = rng.uniform(), shift_v = rng.uniform();
  for (std::size_t i = 0; i < links; ++i) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(links) + shift_u;
    const double v = radical_inverse(static_cast<unsigned>(i)) + shift_v;
    fan.directions.push_back(cosine_direction(u - std::floor(u), v - std::floor(v)));
    fan.sites.push_back(i);
  }
  for (std::size_t i = links - 1; i > 0; --i) {
    std::swap(fan.sites[i], fan.sites[rng.next() % (i + 1)]);
  }
  return fan;
}

std::array<Fan, kFans> make_fans(std::size_t links) {
  std::array<Fan, kFans> fans;
  for (std::size_t f = 0; f < kFans; ++f) fans[f] = make_fan(f, links);
  return fans;
}

const Fan& fan_of(const Patch& patch) {
  static const std::array<Fan, kFans> whole = make_fans(kLinks), fine = make_fans(kFineLinks);
  return (patch.is_part() ? fine : whole)[patch.hash % kFans];
}

rays::Ray ray_from(const Vec3& origin, const Vec3& direction) {
  rays::Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.min = kMargin;
  return ray;
}

}  // namespace

/// Each patch turns its fan about the normal by its own angle.
std::vector<rays::Ray> link_rays(const Patch& patch) {
  const Fan& fan = fan_of(patch);
  const double angle = 2.0 * M_PI * static_cast<double>(patch.hash >> 40) / (1 << 24);
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<rays::Ray> rays;
  rays.reserve(fan.directions.size());
  for (std::size_t i = 0; i < fan.directions.size(); ++i) {
    const Site& site = patch.sites[fan.sites[i] % patch.sites.size()];
    const Vec3& d = fan.directions[i];
    const Vec3 turned(c * d.x() - s * d.y(), s * d.x() + c * d.y(), d.z());
    rays.push_back(ray_from(site.position, (frame_about(site.normal) * turned).normalized()));
  }
  return rays;
}

Vec3 end_of(const rays::Ray& ray, double range) {
  return ray.origin + std::min(range, kFarthest) * ray.direction;
}

std::vector<rays::Ray> first_rays(const Lamp& lamp, const Eigen::AlignedBox3d& world) {
  std::vector<rays::Ray> rays;
  const Vec3 shines = lamp.pose.rotation * lamp.direction;
  const Eigen::Matrix3d frame = frame_about(shines);
  if (lamp.type == Lamp::Type::kDirectional) {
    const Vec3 middle = world.isEmpty() ? Vec3::Zero() : Vec3(world.center());
    const double half = world.isEmpty() ? 1.0 : world.diagonal().norm() / 2;
    for (std::size_t i = 0; i < kLattice * kLattice; ++i) {
      const double u = 2.0 * (static_cast<double>(i % kLattice) + 0.5) / kLattice - 1.0;
      const double v = 2.0 * (static_cast<double>(i / kLattice) + 0.5) / kLattice - 1.0;
      rays.push_back(ray_from(middle + half * (frame * Vec3(u, v, -1.0)), shines));
    }
    return rays;
  }
  for (std::size_t i = 0; i < kFirst; ++i) {
    const double u = (static_cast<double>(i) + 0.5) / kFirst;
    const double v = radical_inverse(static_cast<unsigned>(i));
    if (lamp.flat()) {
      rays.push_back(ray_from(lamp_point(lamp, i), frame * cosine_direction(u, v)));
      continue;
    }
    const double z = 1.0 - 2.0 * u, around = std::sqrt(1.0 - z * z), angle = 2.0 * M_PI * v;
    const Vec3 way(around * std::cos(angle), around * std::sin(angle), z);
    if (beam(lamp, lamp.pose.position + way).illuminance > 0.0) {
      rays.push_back(ray_from(lamp.pose.position, way));
    }
  }
  return rays;
}

}  // namespace angen::light
