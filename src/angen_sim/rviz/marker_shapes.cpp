#include "rviz/marker_shapes.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "ros/convert.h"

namespace angen::node {
namespace {

using visualization_msgs::Marker;

constexpr double kThin = 0.002;     // m, a plane's slab
constexpr double kEndless = 100.0;  // m, a plane without a size
constexpr double kRayWidth = 0.01;  // m
constexpr double kDarkBall = 0.1;   // m, diameter of a lamp's light
constexpr double kLitBall = 0.5;    // m, its glow at full level

Marker sized(int type, double x, double y, double z) {
  Marker marker;
  marker.type = type;
  marker.scale.x = std::max(x, 1e-4);
  marker.scale.y = std::max(y, 1e-4);
  marker.scale.z = std::max(z, 1e-4);
  return marker;
}

bool carries_colors(const std::string& file) {
  const std::string ending = file.size() > 4 ? file.substr(file.size() - 4) : "";
  return ending == ".dae" || ending == ".DAE" || ending == ".obj" || ending == ".OBJ";
}

Marker draw_file(const Shape& shape) {
  Marker marker = sized(Marker::MESH_RESOURCE, shape.mesh_scale.x(), shape.mesh_scale.y(),
                        shape.mesh_scale.z());
  marker.mesh_resource = file_address(shape.mesh_file);
  marker.mesh_use_embedded_materials = carries_colors(shape.mesh_file);
  return marker;
}

Marker draw_triangles(const TriangleMesh& mesh) {
  Marker marker = sized(Marker::TRIANGLE_LIST, 1.0, 1.0, 1.0);
  marker.points.reserve(mesh.triangles.size() * 3);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      marker.points.push_back(to_point(mesh.vertices[vertex].cast<double>()));
    }
  }
  return marker;
}

// A message holds three points a triangle: the grid is thinned to that many columns and rows.
Marker draw_heights(const HeightGrid& grid) {
  constexpr std::uint32_t kMaxCells = 128;
  Marker marker = sized(Marker::TRIANGLE_LIST, 1.0, 1.0, 1.0);
  const std::uint32_t across = std::min(kMaxCells, grid.columns - 1);
  const std::uint32_t down = std::min(kMaxCells, grid.rows - 1);
  const auto add = [&](std::uint32_t column, std::uint32_t row) {
    const Eigen::Vector3f vertex =
        grid.vertex(column * (grid.columns - 1) / across, row * (grid.rows - 1) / down);
    marker.points.push_back(to_point(vertex.cast<double>()));
  };
  for (std::uint32_t row = 0; row < down; ++row) {
    for (std::uint32_t column = 0; column < across; ++column) {
      add(column, row);
      add(column, row + 1);
      add(column + 1, row);
      add(column + 1, row);
      add(column, row + 1);
      add(column + 1, row + 1);
    }
  }
  return marker;
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
  const Shape& shape = visual.shape;
  const double width = 2 * shape.radius;
  std::vector<Drawing> drawings;
  const auto add = [&](Marker marker, const Pose& offset = {}) {
    const Eigen::Vector4f& c = visual.material.diffuse;
    if (!marker.mesh_use_embedded_materials) marker.color = color(c[0], c[1], c[2], c[3]);
    drawings.push_back({std::move(marker), visual.pose * offset});
  };
  switch (shape.type) {
    case Shape::Type::kEmpty:
      break;
    case Shape::Type::kBox:
      add(sized(Marker::CUBE, shape.size.x(), shape.size.y(), shape.size.z()));
      break;
    case Shape::Type::kSphere:
      add(sized(Marker::SPHERE, width, width, width));
      break;
    case Shape::Type::kCylinder:
      add(sized(Marker::CYLINDER, width, width, shape.length));
      break;
    case Shape::Type::kCapsule:
      add(sized(Marker::CYLINDER, width, width, shape.length));
      for (const double end : {-0.5, 0.5}) {
        add(sized(Marker::SPHERE, width, width, width),
            {Vec3(0, 0, end * shape.length), Quat::Identity()});
      }
      break;
    case Shape::Type::kPlane: {
      const double x = shape.size.x() > 0 ? shape.size.x() : kEndless;
      const double y = shape.size.y() > 0 ? shape.size.y() : kEndless;
      add(sized(Marker::CUBE, x, y, kThin), {Vec3(0, 0, -kThin / 2), Quat::Identity()});
      break;
    }
    case Shape::Type::kMesh:
      if (!shape.mesh_file.empty()) {
        add(draw_file(shape));
      } else if (shape.mesh != nullptr) {
        add(draw_triangles(*shape.mesh));
      }
      break;
    case Shape::Type::kHeightmap:
      if (shape.heights != nullptr) add(draw_heights(*shape.heights));
      break;
  }
  return drawings;
}

Marker draw(const desc::Light& light, double level) {
  const double part = std::sqrt(std::clamp(level, 0.0, 1.0));
  const double width = part > 0.0 ? kDarkBall + (kLitBall - kDarkBall) * part : kDarkBall;
  Marker marker = sized(Marker::SPHERE, width, width, width);
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
