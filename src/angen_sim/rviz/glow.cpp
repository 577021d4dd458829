#include "rviz/glow.h"

#include <algorithm>
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

/// 0..1, saturating as film does.
double brightness(const LitFace& face, const Vec3& point, const Vec3& lamp, double level) {
  const Vec3 way = lamp - point;
  const double distance = std::max(way.norm(), 0.1);
  const double direct = std::max(0.0, way.dot(face.normal)) / std::pow(distance, 3);
  const double light = level * (kDirect * direct + kReflected);
  return light / (light + 1.0);
}

}  // namespace

std::vector<LitFace> lit_faces(const Room& room) {
  Eigen::AlignedBox2d around;
  for (const Point2& corner : room.outline) around.extend(corner);
  const Point2 low = around.min() + Point2::Constant(kSkin);
  const Point2 size = around.sizes() - Point2::Constant(2 * kSkin);
  const double bottom = room.floor + kSkin;
  const Vec3 up(0, 0, room.ceiling - room.floor - kSkin);
  std::vector<LitFace> faces = {
      {{low.x(), low.y(), bottom}, {size.x(), 0, 0}, {0, size.y(), 0}, Vec3::UnitZ(), kFloorAlpha}};
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    const Point2& from = room.outline[i];
    const Point2 edge = room.outline[(i + 1) % room.outline.size()] - from;
    const Point2 inward = Point2(-edge.y(), edge.x()).normalized();
    const Point2 along = edge.normalized() * kSkin;
    const Point2 corner = from + kSkin * inward + along;
    const Point2 length = edge - 2 * along;
    faces.push_back({{corner.x(), corner.y(), bottom},
                     {length.x(), length.y(), 0},
                     up,
                     {inward.x(), inward.y(), 0},
                     kWallAlphaLit});
  }
  return faces;
}

Marker draw_glow(const Room& room, const std::vector<LitFace>& faces, const Vec3& point,
                 const desc::Light& light, double level) {
  Marker marker;
  marker.type = Marker::TRIANGLE_LIST;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color = color(1.0F, 1.0F, 1.0F, 1.0F);
  const Eigen::Vector3f c = light.diffuse / std::max(light.diffuse.maxCoeff(), 1e-3F);
  for (const LitFace& face : faces) {
    const auto put = [&](int i, int j) {
      const Vec3 at = face.corner + face.u * i / kCells + face.v * j / kCells;
      const auto alpha = static_cast<float>(face.alpha * brightness(face, at, point, level));
      marker.points.push_back(to_point(at - point));
      marker.colors.push_back(color(c[0], 0.93F * c[1], 0.6F * c[2], alpha));
    };
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) {
        const Vec3 middle = face.corner + face.u * (i + 0.5) / kCells + face.v * (j + 0.5) / kCells;
        if (face.normal.z() > 0.0 && !room.contains(middle.head<2>())) continue;
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
