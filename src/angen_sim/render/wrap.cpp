#include "render/wrap.h"

#include <cmath>

namespace angen::render {

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
