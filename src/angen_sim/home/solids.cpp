#include "home/solids.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace angen {

Eigen::AlignedBox3d OrientedBox::bounds() const {
  const Vec3 half = pose.rotation.toRotationMatrix().cwiseAbs() * size / 2;
  return {Vec3(pose.position - half), Vec3(pose.position + half)};
}

std::optional<OrientedBox> box_around(const Shape& shape, const Pose& frame) {
  switch (shape.type) {
    case Shape::Type::kBox:
      return OrientedBox{frame, shape.size};
    case Shape::Type::kSphere:
      return OrientedBox{frame, Vec3::Constant(2 * shape.radius)};
    case Shape::Type::kCylinder:
      return OrientedBox{frame, {2 * shape.radius, 2 * shape.radius, shape.length}, true};
    case Shape::Type::kCapsule:
      return OrientedBox{
          frame, {2 * shape.radius, 2 * shape.radius, shape.length + 2 * shape.radius}, true};
    case Shape::Type::kMesh: {
      Eigen::AlignedBox3f box;
      if (shape.mesh != nullptr) {
        for (const Eigen::Vector3f& vertex : shape.mesh->vertices) box.extend(vertex);
      }
      if (box.isEmpty()) return std::nullopt;
      const Pose middle{box.center().cast<double>(), Quat::Identity()};
      return OrientedBox{frame * middle, box.sizes().cast<double>()};
    }
    default:
      return std::nullopt;
  }
}

namespace {

// Half of its extent along an axis.
double reach_of(const OrientedBox& box, const Eigen::Matrix3d& turn, const Vec3& axis) {
  const Vec3 local = turn.transpose() * axis;
  if (!box.round) return local.cwiseAbs().dot(box.size) / 2;
  return (local.head<2>().norm() * box.size.x() + std::abs(local.z()) * box.size.z()) / 2;
}

// From the middle of a round box, across it, to the nearest point of another one.
Vec3 across_to(const OrientedBox& round, const OrientedBox& other) {
  const Vec3 half = other.size / 2;
  const Vec3 inside = (other.pose.inverse() * round.pose.position).cwiseMax(-half).cwiseMin(half);
  const Vec3 upright = round.pose.rotation * Vec3::UnitZ();
  const Vec3 there = other.pose * inside - round.pose.position;
  return there - there.dot(upright) * upright;
}

}  // namespace

double overlap_of(const OrientedBox& a, const OrientedBox& b) {
  const Eigen::Matrix3d turn_a = a.pose.rotation.toRotationMatrix();
  const Eigen::Matrix3d turn_b = b.pose.rotation.toRotationMatrix();
  const Vec3 between = b.pose.position - a.pose.position;
  double least = std::numeric_limits<double>::infinity();
  const auto along = [&](const Vec3& way) {
    if (way.norm() < 1e-6) return;
    const Vec3 axis = way.normalized();
    const double reach = reach_of(a, turn_a, axis) + reach_of(b, turn_b, axis);
    least = std::min(least, reach - std::abs(between.dot(axis)));
  };
  if (a.round) along(across_to(a, b));
  if (b.round) along(across_to(b, a));
  for (int i = 0; i < 3; ++i) {
    along(turn_a.col(i));
    along(turn_b.col(i));
    for (int j = 0; j < 3; ++j) along(turn_a.col(i).cross(turn_b.col(j)));
  }
  return least;
}

std::vector<OrientedBox> solid_boxes(const HomeSurvey::Standing& standing) {
  std::vector<OrientedBox> boxes;
  for (const desc::Link& link : standing.model->links) {
    for (const desc::Collision& collision : link.collisions) {
      const Pose frame = standing.pose * link.pose * collision.pose;
      if (const auto box = box_around(collision.shape, frame)) boxes.push_back(*box);
    }
  }
  return boxes;
}

}  // namespace angen
