#include "render/tessellate.h"

#include <cmath>

namespace angen::render {

namespace {

constexpr int kSides = 64;  // sides of a circle: chords are within 0.12 % of the radius
constexpr float kEndlessPlane = 500.0F;

using Index = std::uint32_t;

void quad(TriangleMesh& mesh, Index a, Index b, Index c, Index d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

TriangleMesh box(const Eigen::Vector3f& half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(half.cwiseProduct(Eigen::Vector3f(
        (i & 1) != 0 ? 1.F : -1.F, (i & 2) != 0 ? 1.F : -1.F, (i & 4) != 0 ? 1.F : -1.F)));
  }
  quad(mesh, 0, 2, 3, 1);
  quad(mesh, 4, 5, 7, 6);
  quad(mesh, 0, 1, 5, 4);
  quad(mesh, 2, 6, 7, 3);
  quad(mesh, 0, 4, 6, 2);
  quad(mesh, 1, 3, 7, 5);
  return mesh;
}

TriangleMesh plane(const Vec3& size) {
  const float x = size.x() > 0.0 ? static_cast<float>(size.x()) / 2 : kEndlessPlane;
  const float y = size.y() > 0.0 ? static_cast<float>(size.y()) / 2 : kEndlessPlane;
  TriangleMesh mesh;
  mesh.vertices = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
  quad(mesh, 0, 1, 2, 3);
  return mesh;
}

/// A body of revolution about z through rings of (radius, z), from below; rings of radius 0 are its
/// poles.
TriangleMesh lathe(const std::vector<std::pair<double, double>>& rings) {
  TriangleMesh mesh;
  for (const auto& [radius, z] : rings) {
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2.0 * M_PI * i / kSides;
      mesh.vertices.push_back(
          Vec3(radius * std::cos(angle), radius * std::sin(angle), z).cast<float>());
    }
  }
  for (Index ring = 0; ring + 1 < rings.size(); ++ring) {
    for (Index i = 0; i < kSides; ++i) {
      const Index next = (i + 1) % kSides;
      quad(mesh, ring * kSides + i, ring * kSides + next, (ring + 1) * kSides + next,
           (ring + 1) * kSides + i);
    }
  }
  return mesh;
}

/// A ball cut in two at its equator, the halves `length` apart.
TriangleMesh capsule(double radius, double length) {
  std::vector<std::pair<double, double>> rings;
  constexpr int kRings = kSides / 4;
  for (int i = -kRings; i <= kRings; ++i) {
    const double up = 0.5 * M_PI * i / kRings;
    const double reach = std::abs(i) == kRings ? 0.0 : radius * std::cos(up);
    if (i == 0) rings.emplace_back(reach, -0.5 * length);
    if (i == 0 && !(length > 0.0)) continue;
    rings.emplace_back(reach, radius * std::sin(up) + (i < 0 ? -0.5 : 0.5) * length);
  }
  return lathe(rings);
}

}  // namespace

TriangleMesh tessellate(const Shape& shape) {
  const double half = 0.5 * shape.length;
  switch (shape.type) {
    case Shape::Type::kBox:
      if (!shape.size.allFinite()) return {};
      return box((0.5 * shape.size).cast<float>());
    case Shape::Type::kPlane:
      return plane(shape.size);
    case Shape::Type::kSphere:
      return capsule(shape.radius, 0.0);
    case Shape::Type::kCylinder:
      return lathe({{0.0, -half}, {shape.radius, -half}, {shape.radius, half}, {0.0, half}});
    case Shape::Type::kCapsule:
      return capsule(shape.radius, shape.length);
    case Shape::Type::kMesh:
      return shape.mesh ? *shape.mesh : TriangleMesh{};
    case Shape::Type::kHeightmap:  // rays hit its TriangleTree
    case Shape::Type::kEmpty:
      break;
  }
  return {};
}

namespace {

using Point = Eigen::Vector2f;

Point on_box(const Eigen::Vector3f& p, const Eigen::Vector3f& size, int axis, bool front) {
  const Eigen::Vector3f part = p.cwiseQuotient(size.cwiseMax(1e-6F));
  const float turn = front ? 1.0F : -1.0F;
  if (axis == 0) return {0.5F + turn * part.y(), 0.5F + part.z()};
  if (axis == 1) return {0.5F - turn * part.x(), 0.5F + part.z()};
  return {0.5F + turn * part.x(), 0.5F + part.y()};
}

Point on_plane(const Eigen::Vector3f& p, const Vec3& size) {
  const auto part = [](float at, double extent) {
    return extent > 0.0 ? 0.5F + at / static_cast<float>(extent) : at;
  };
  return {part(p.x(), size.x()), part(p.y(), size.y())};
}

// Around z; all corners of a triangle are on the side of the seam where its middle is.
Point on_round(const Eigen::Vector3f& p, double height, float around_middle) {
  const bool pole = p.head<2>().norm() < 1e-6F;
  const float around = pole ? around_middle : std::atan2(p.y(), p.x());
  const auto full = static_cast<float>(2.0 * M_PI);
  const float turned = around_middle + std::remainder(around - around_middle, full);
  return {0.5F + turned / full, 0.5F + p.z() / static_cast<float>(height)};
}

Point on_lid(const Eigen::Vector3f& p, double radius, bool top) {
  const auto across = static_cast<float>(2.0 * radius);
  return {0.5F + (top ? 1.0F : -1.0F) * p.x() / across, 0.5F + p.y() / across};
}

}  // namespace

std::array<float, 6> wrapped(const Shape& shape, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                             const Eigen::Vector3f& c) {
  const Eigen::Vector3f normal = (b - a).cross(c - a);
  const Eigen::Vector3f middle = (a + b + c) / 3.0F;
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const bool front = normal[axis] > 0.0F;
  const double height = std::max(
      1e-6, shape.type == Shape::Type::kCylinder ? shape.length : shape.length + 2 * shape.radius);
  const auto place = [&](const Eigen::Vector3f& p) -> Point {
    if (shape.type == Shape::Type::kBox) return on_box(p, shape.size.cast<float>(), axis, front);
    if (shape.type == Shape::Type::kPlane) return on_plane(p, shape.size);
    const bool lid = shape.type == Shape::Type::kCylinder && normal.head<2>().norm() < 1e-9F;
    if (lid) return on_lid(p, std::max(1e-6, shape.radius), front);
    return on_round(p, height, std::atan2(middle.y(), middle.x()));
  };
  const Point at[3] = {place(a), place(b), place(c)};
  return {at[0].x(), at[0].y(), at[1].x(), at[1].y(), at[2].x(), at[2].y()};
}

}  // namespace angen::render
