#include "rviz/marker_shapes.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "ros/convert.h"
#include "scene/shapes.h"

namespace angen::node {
namespace {

using visualization_msgs::Marker;

constexpr double kRayWidth = 0.01;  // m
constexpr double kDarkBall = 0.1;   // m, diameter of a lamp's light
constexpr double kLitBall = 0.5;    // m, its glow at full level

Marker sized(int type, const Vec3& size) {
  Marker marker;
  marker.type = type;
  marker.scale = to_vector(size);
  return marker;
}

bool carries_colors(const std::string& file) {
  const std::string ending = file.size() > 4 ? file.substr(file.size() - 4) : "";
  return ending == ".dae" || ending == ".DAE" || ending == ".obj" || ending == ".OBJ";
}

Marker draw_file(const Shape& shape) {
  Marker marker = sized(Marker::MESH_RESOURCE, shape.mesh_scale.cwiseMax(1e-4));
  marker.mesh_resource = file_address(shape.mesh_file);
  marker.mesh_use_embedded_materials = carries_colors(shape.mesh_file);
  return marker;
}

Marker draw_triangles(const TriangleMesh& mesh) {
  Marker marker = sized(Marker::TRIANGLE_LIST, Vec3::Ones());
  marker.points.reserve(mesh.triangles.size() * 3);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      marker.points.push_back(to_point(mesh.vertices[vertex].cast<double>()));
    }
  }
  return marker;
}

Marker draw_part(const scene::Part& part, const Shape& shape) {
  switch (part.type) {
    case scene::Part::Type::kBox:
      return sized(Marker::CUBE, part.size);
    case scene::Part::Type::kSphere:
      return sized(Marker::SPHERE, part.size);
    case scene::Part::Type::kCylinder:
      return sized(Marker::CYLINDER, part.size);
    case scene::Part::Type::kMesh:
      break;
  }
  return shape.mesh_file.empty() ? draw_triangles(*part.mesh) : draw_file(shape);
}

}  // namespace

std::string file_address(const std::string& path) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string out = "file://";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || std::string("/-_.~").find(c) != std::string::npos) {
      out += c;
    } else {
      out += {'%', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return out;
}

std::vector<Drawing> draw(const desc::Visual& visual) {
  std::vector<Drawing> drawings;
  for (const scene::Part& part : scene::parts_of(visual)) {
    Marker marker = draw_part(part, visual.shape);
    const Eigen::Vector4f& c = visual.material.diffuse;
    if (!marker.mesh_use_embedded_materials) marker.color = color(c[0], c[1], c[2], c[3]);
    drawings.push_back({std::move(marker), part.pose});
  }
  return drawings;
}

Marker draw(const desc::Light& light, double level) {
  const double part = std::sqrt(std::clamp(level, 0.0, 1.0));
  const double width = part > 0.0 ? kDarkBall + (kLitBall - kDarkBall) * part : kDarkBall;
  Marker marker = sized(Marker::SPHERE, Vec3::Constant(width));
  const Eigen::Vector3f c = light.diffuse / std::max(light.diffuse.maxCoeff(), 1e-3F);
  marker.color =
      part > 0.0 ? color(c[0], 0.95F * c[1], 0.4F * c[2], 0.75F) : color(0.25F, 0.25F, 0.28F, 1.0F);
  return marker;
}

Marker draw_rays(const RayGeometry& rays, double tilt, const std::vector<double>& ranges) {
  Marker marker;
  marker.type = Marker::LINE_LIST;
  marker.scale.x = kRayWidth;
  std::size_t i = 0;
  for (const Vec3& direction : rays.directions(tilt)) {
    const double range = i < ranges.size() ? std::clamp(ranges[i], 0.0, rays.max) : rays.max;
    ++i;
    marker.points.push_back(to_point(Vec3::Zero()));
    marker.points.push_back(to_point(direction * range));
  }
  return marker;
}

}  // namespace angen::node
