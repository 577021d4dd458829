#include "plugin/ray_geometry.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace angen {

namespace {

constexpr Range kSamples{1.0, 10000.0};
constexpr Range kPitch{-M_PI, M_PI};
constexpr Range kYaw{-2.0 * M_PI - 1e-3, 2.0 * M_PI + 1e-3};  // files round 2 pi
constexpr double kFullTurn = 2.0 * M_PI + 1e-3;

// `block` has <min…> and <max…>.
void check_order(const Params& params, const std::string& block, double first, double last) {
  if (first > last) throw params.error(block, "<" + block + ">: min is above max");
}

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

std::vector<Vec3> RayGeometry::detecting() const {
  if (!zones.empty()) return zones;
  if (tilts.empty()) return directions();
  std::vector<Vec3> all;
  for (const double tilt : tilts) {
    const std::vector<Vec3> tilted = directions(tilt);
    all.insert(all.end(), tilted.begin(), tilted.end());
  }
  return all;
}

RayGeometry read_rays(Params& params, const RayGeometry& fallback) {
  const std::string h = "ray/scan/horizontal/";
  const std::string v = "ray/scan/vertical/";
  RayGeometry rays;
  rays.columns = params.integer(h + "samples", fallback.columns, "", "rays side by side", kSamples);
  rays.min_yaw = params.number(h + "min_angle", fallback.min_yaw, "rad", "rightmost ray", kYaw);
  rays.max_yaw = params.number(h + "max_angle", fallback.max_yaw, "rad", "leftmost ray", kYaw);
  rays.rows = params.integer(v + "samples", fallback.rows, "", "rows of rays", kSamples);
  rays.min_pitch = params.number(v + "min_angle", fallback.min_pitch, "rad", "lowest row", kPitch);
  rays.max_pitch = params.number(v + "max_angle", fallback.max_pitch, "rad", "highest row", kPitch);
  rays.min = params.number("ray/range/min", fallback.min, "m", "nearer is not seen", kNotNegative);
  rays.max = params.number("ray/range/max", fallback.max, "m", "farther is not seen", kPositive);
  check_order(params, "ray/scan/horizontal", rays.min_yaw, rays.max_yaw);
  if (rays.max_yaw - rays.min_yaw > kFullTurn) {
    throw params.error("ray/scan/horizontal", "<ray/scan/horizontal>: more than a full turn");
  }
  check_order(params, "ray/scan/vertical", rays.min_pitch, rays.max_pitch);
  check_order(params, "ray/range", rays.min, rays.max);
  return rays;
}

Eigen::Vector4f read_ray_color(Params& params, const Kind& kind) {
  const std::string text =
      params.text("color", kind.ray_color(), "of its rays in rviz: red green blue alpha, 0 to 1");
  const auto [shares, bad] = numbers_in(text);
  const bool all = std::all_of(shares.begin(), shares.end(),
                               [](double share) { return share >= 0.0 && share <= 1.0; });
  if (bad.empty() && all && (shares.size() == 3 || shares.size() == 4)) {
    Eigen::Vector4f color(0.0F, 0.0F, 0.0F, 1.0F);
    std::copy(shares.begin(), shares.end(), color.data());
    return color;
  }
  throw params.error("color", "<color> is \"" + text + "\", must be 3 or 4 numbers from 0 to 1");
}

}  // namespace angen
