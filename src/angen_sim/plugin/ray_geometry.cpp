#include "plugin/ray_geometry.h"

#include <cmath>

namespace angen {

namespace {

double angle_of(double first, double last, int index, int count) {
  return count == 1 ? 0.5 * (first + last) : first + (last - first) * index / (count - 1);
}

}  // namespace

std::vector<Vec3> RayGeometry::directions(double tilt) const {
  const Eigen::AngleAxisd upwards(-tilt, Vec3::UnitY());
  std::vector<Vec3> result;
  result.reserve(size());
  for (int row = 0; row < rows; ++row) {
    const double up = angle_of(min_pitch, max_pitch, row, rows);
    for (int column = 0; column < columns; ++column) {
      const double left = angle_of(min_yaw, max_yaw, column, columns);
      const Vec3 direction{std::cos(up) * std::cos(left), std::cos(up) * std::sin(left),
                           std::sin(up)};
      result.push_back((upwards * direction).normalized());
    }
  }
  return result;
}

}  // namespace angen
