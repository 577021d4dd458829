#include "light/transport.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "light/beam.h"
#include "light/hemisphere.h"
#include "light/shadow.h"

namespace angen::light {
namespace {

constexpr std::size_t kViewPoints = 16;                    // sample points of a flat lamp or a tube
const Rgb kLuminance = {0.2126F, 0.7152F, 0.0722F, 0.0F};  // Rec. 709

struct Direct {
  double illuminance = 0.0;  // lx
  double radiance = 0.0;     // cd/m^2, the lamp's own share of the one-pixel view
};

Direct direct(const rays::Scene& scene, const Pose& pose, const Lamp& lamp,
              Eigen::AlignedBox3d& reach) {
  const Vec3 normal = pose.rotation * Vec3::UnitX();
  const double free = illuminance(lamp, pose.position, normal);
  if (free <= 0.0) return {};
  const double share = visible_share(scene, lamp, pose.position, normal, rays::kAll);
  if (share > 0.0 ||
      sees_any(scene, lamp, pose.position, normal, rays::only(rays::Mobility::kStatic))) {
    extend(reach, lamp);
  }
  Direct out;
  out.illuminance = free * share;
  if (lamp.type == Lamp::Type::kDirectional) return out;
  // A solid angle w covers w / x^3 of the image plane, so the lamp's size does not matter.
  const bool extended = lamp.flat() || lamp.type == Lamp::Type::kTube;
  const std::size_t points = extended ? kViewPoints : 1;
  for (std::size_t i = 0; i < points; ++i) {
    Lamp part = lamp;
    if (extended) part.pose.position = lamp_point(lamp, i);
    part.radius = extended ? 0.0 : lamp.radius;
    const Beam from = beam(part, pose.position);
    const Vec3 local = pose.rotation.conjugate() * from.towards;
    if (!in_view(local)) continue;
    out.radiance += share * from.illuminance / static_cast<double>(points) /
                    (std::pow(local.x(), 3) * view_area());
  }
  return out;
}

}  // namespace

void make_infinite(Eigen::AlignedBox3d& box) {
  const Vec3 corner = Vec3::Constant(std::numeric_limits<double>::infinity());
  box = {-corner, corner};
}

void extend(Eigen::AlignedBox3d& reach, const Lamp& lamp) {
  if (lamp.type == Lamp::Type::kDirectional) {
    make_infinite(reach);
    return;
  }
  const double out = std::max(
      {lamp.radius, std::hypot(lamp.width, lamp.height) / 2, lamp.length / 2 + lamp.radius});
  reach.extend(lamp.pose.position - Vec3::Constant(out));
  reach.extend(lamp.pose.position + Vec3::Constant(out));
}

Transport transport(const rays::Scene& scene, const Pose& pose, const Lamp& lamp,
                    const Gathered& gathered, const Eigen::AlignedBox3d& reach) {
  Transport out;
  out.reach = reach;
  const Direct own = direct(scene, pose, lamp, out.reach);
  Rgb color = Rgb::Zero();
  color.head<3>() = lamp.color.array();
  out.illuminance = own.illuminance + (kLuminance * color * gathered.illuminance).sum();
  const Rgb radiance =
      color * (static_cast<float>(own.radiance) + gathered.view / static_cast<float>(M_PI));
  out.radiance = radiance.head<3>().matrix();
  return out;
}

}  // namespace angen::light
