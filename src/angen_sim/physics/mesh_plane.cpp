#include <algorithm>
#include <array>
#include <cmath>

#include "physics/touching.h"

namespace angen::physics {

namespace {

constexpr std::size_t kDirections = kMaxOnPlane - 1;

struct Extreme {
  Vec3 direction;  // in the mesh's frame
  double reach = -dInfinity;
  Eigen::Index corner = -1;

  void update(Eigen::Index i, const Vec3& at) {
    const double along = direction.dot(at);
    if (along <= reach) return;
    reach = along;
    corner = i;
  }
};

std::array<Extreme, kMaxOnPlane> extremes_of(const Vec3& normal) {
  const Vec3 right = normal.unitOrthogonal();
  const Vec3 ahead = normal.cross(right);
  std::array<Extreme, kMaxOnPlane> out;
  out[0].direction = -normal;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * M_PI * static_cast<double>(i) / kDirections;
    out[i + 1].direction = std::cos(angle) * right + std::sin(angle) * ahead;
  }
  return out;
}

}  // namespace

std::size_t collide_mesh_plane(const Geom& mesh, const Vec3& normal, double offset,
                               dContactGeom* points) {
  const Pose pose = mesh.body->at * mesh.in_body;
  const Vec3 own_normal = pose.rotation.inverse() * normal;
  const double height = normal.dot(pose.position) - offset;
  const Eigen::Matrix3Xd& corners = mesh.mesh->corners;
  thread_local Eigen::RowVectorXd heights;
  heights.noalias() = own_normal.transpose() * corners;

  std::array<Extreme, kMaxOnPlane> extremes = extremes_of(own_normal);
  for (Eigen::Index i = 0; i < corners.cols(); ++i) {
    if (heights[i] + height >= 0.0) continue;
    for (Extreme& extreme : extremes) extreme.update(i, corners.col(i));
  }
  std::size_t found = 0;
  std::array<Eigen::Index, kMaxOnPlane> seen{};
  for (const Extreme& extreme : extremes) {
    const auto end = seen.begin() + static_cast<std::ptrdiff_t>(found);
    if (extreme.corner < 0 || std::find(seen.begin(), end, extreme.corner) != end) continue;
    dContactGeom& point = points[found];
    point = {};
    const Vec3 at = pose * Vec3(corners.col(extreme.corner));
    for (int axis = 0; axis < 3; ++axis) {
      point.pos[axis] = at[axis];
      point.normal[axis] = normal[axis];
    }
    point.depth = -(heights[extreme.corner] + height);
    point.g1 = mesh.ode.get();
    point.side1 = point.side2 = -1;
    seen[found++] = extreme.corner;
  }
  return found;
}

}  // namespace angen::physics
