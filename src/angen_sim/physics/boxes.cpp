#include "physics/touching.h"

namespace angen::physics {

namespace {

// A side's part along another that is less than this is none: over 1 m it makes 0.1 um.
constexpr double kParallel = 1e-7;

using RowMajor = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;  // dMatrix3

Eigen::Matrix3d rotation(dGeomID geom) {
  return Eigen::Map<const RowMajor>(dGeomGetRotation(geom)).leftCols<3>();
}

}  // namespace

// In the frame of `a`, in which its axes are exact and parallel ones stay parallel to the last bit.
std::size_t collide_boxes(dGeomID a, dGeomID b, dContactGeom* points, std::size_t most) {
  const Eigen::Matrix3d frame = rotation(a);
  const Vec3 origin = ode::vec(dGeomGetPosition(a));
  const Eigen::Matrix3d turn = frame.transpose() * rotation(b);
  const Vec3 offset = frame.transpose() * (ode::vec(dGeomGetPosition(b)) - origin);
  const RowMajor upright = RowMajor::Identity();
  RowMajor turned = RowMajor::Zero();
  turned.leftCols<3>() = (turn.array().abs() < kParallel).select(0.0, turn);
  const dVector3 zero{};
  const dVector3 there{offset.x(), offset.y(), offset.z()};
  dVector3 size_a;
  dVector3 size_b;
  dGeomBoxGetLengths(a, size_a);
  dGeomBoxGetLengths(b, size_b);
  dVector3 normal{};
  dReal depth = 0.0;
  int code = 0;
  const int found =
      dBoxBox(zero, upright.data(), size_a, there, turned.data(), size_b, normal, &depth, &code,
              static_cast<int>(most), points, static_cast<int>(sizeof(dContactGeom)));
  const Vec3 towards_a = frame * -ode::vec(normal);
  for (int i = 0; i < found; ++i) {
    const Vec3 at = origin + frame * ode::vec(points[i].pos);
    for (int axis = 0; axis < 3; ++axis) {
      points[i].pos[axis] = at[axis];
      points[i].normal[axis] = towards_a[axis];
    }
    points[i].g1 = a;
    points[i].g2 = b;
    points[i].side1 = points[i].side2 = -1;
  }
  return static_cast<std::size_t>(found);
}

}  // namespace angen::physics
