#include "rviz/glow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ros/convert.h"
#include "rviz/marker_shapes.h"

namespace angen::node {
namespace {

using visualization_msgs::Marker;

constexpr int kCells = 8;            // along each edge of a floor or wall
constexpr double kSkin = 0.02;       // m over the floor and before the walls
constexpr double kDirect = 12.0;     // m^2: weight of cos/d^2
constexpr double kReflected = 0.25;  // share that walls and ceiling reflect, everywhere
constexpr double kFloorAlpha = 0.75;
constexpr double kWallAlphaLit = 0.3;

/// A rectangle that is lit: a corner, its edges, and the direction that it faces.
struct LitFace {
  Vec3 corner;
  Vec3 u;
  Vec3 v;
  Vec3 normal;
  double alpha;  // under endless light
};

std::array<LitFace, 5> faces_of(const Vec3& size) {
  const double x = size.x() / 2 - kSkin;
  const double y = size.y() / 2 - kSkin;
  const Vec3 along(2 * x, 0, 0);
  const Vec3 across(0, 2 * y, 0);
  const Vec3 up(0, 0, size.z() - kSkin);
  const Vec3 low(-x, -y, kSkin);
  return {{{low, along, across, Vec3::UnitZ(), kFloorAlpha},
           {low, along, up, Vec3::UnitY(), kWallAlphaLit},
           {low + across, along, up, -Vec3::UnitY(), kWallAlphaLit},
           {low, across, up, Vec3::UnitX(), kWallAlphaLit},
           {low + along, across, up, -Vec3::UnitX(), kWallAlphaLit}}};
}

/// 0..1, saturating as film does.
double brightness(const LitFace& face, const Vec3& point, const Vec3& lamp, double level) {
  const Vec3 way = lamp - point;
  const double distance = std::max(way.norm(), 0.1);
  const double direct = std::max(0.0, way.dot(face.normal)) / std::pow(distance, 3);
  const double light = level * (kDirect * direct + kReflected);
  return light / (light + 1.0);
}

}  // namespace

Marker draw_glow(const Room& room, const Vec3& point, const desc::Light& light, double level) {
  Marker marker;
  marker.type = Marker::TRIANGLE_LIST;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color = color(1.0F, 1.0F, 1.0F, 1.0F);
  const Vec3 lamp = room.pose.inverse() * point;
  const Eigen::Vector3f c = light.diffuse / std::max(light.diffuse.maxCoeff(), 1e-3F);
  for (const LitFace& face : faces_of(room.size)) {
    const auto put = [&](int i, int j) {
      const Vec3 at = face.corner + face.u * i / kCells + face.v * j / kCells;
      const auto alpha = static_cast<float>(face.alpha * brightness(face, at, lamp, level));
      marker.points.push_back(to_point(at - lamp));
      marker.colors.push_back(color(c[0], 0.93F * c[1], 0.6F * c[2], alpha));
    };
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) {
        for (const auto& [a, b] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1),
                                   std::pair(0, 0), std::pair(1, 1), std::pair(0, 1)}) {
          put(i + a, j + b);
        }
      }
    }
  }
  return marker;
}

}  // namespace angen::node
