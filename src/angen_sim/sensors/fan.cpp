#include "sensors/fan.h"

#include <algorithm>
#include <cmath>

namespace angen::sensors {

namespace {

constexpr Range kSamples{1.0, 10000.0};
constexpr Range kPitch{-M_PI, M_PI};
constexpr Range kYaw{-2.0 * M_PI - 1e-3, 2.0 * M_PI + 1e-3};  // files round 2 pi
constexpr double kFullTurn = 2.0 * M_PI + 1e-3;

double angle(double first, double last, int index, int count) {
  return count == 1 ? 0.5 * (first + last) : first + (last - first) * index / (count - 1);
}

// `block` has <min…> and <max…>.
void check_order(const Params& params, const std::string& block, double first, double last) {
  if (first > last) throw params.error(block, "<" + block + ">: min is above max");
}

}  // namespace

std::vector<Vec3> Fan::directions(double pitch) const {
  const Eigen::AngleAxisd upwards(-pitch, Vec3::UnitY());
  std::vector<Vec3> result;
  result.reserve(size());
  for (int row = 0; row < rows; ++row) {
    const double up = angle(min_pitch, max_pitch, row, rows);
    for (int column = 0; column < columns; ++column) {
      const double left = angle(min_yaw, max_yaw, column, columns);
      const Vec3 direction{std::cos(up) * std::cos(left), std::cos(up) * std::sin(left),
                           std::sin(up)};
      result.push_back((upwards * direction).normalized());
    }
  }
  return result;
}

void Fan::aim(const Pose& pose, const std::vector<Vec3>& directions, RayBatch& rays) const {
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  rays.reserve(rays.size() + directions.size());
  for (const Vec3& direction : directions) {
    rays.push_back({pose.position, (rotation * direction).normalized(), min, max});
  }
}

Ranges Fan::measure(Hits hits) const {
  Ranges ranges;
  ranges.reserve(hits.size());
  for (const rays::Hit& hit : hits) ranges.push_back(std::min(hit.range, max));
  return ranges;
}

Ranges Fan::with_noise(Ranges ranges, Rng rng) const {
  Ranges noise(noise_stddev > 0.0 ? ranges.size() : 0);
  rng.gaussians(noise.data(), noise.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (!(ranges[i] < max)) continue;
    const double error = noise.empty() ? 0.0 : noise_stddev * noise[i];
    ranges[i] = std::clamp(ranges[i] + noise_mean + error, min, max);
  }
  return ranges;
}

Fan read_fan(Params& params, const Fan& fallback) {
  const std::string h = "ray/scan/horizontal/";
  const std::string v = "ray/scan/vertical/";
  Fan fan;
  fan.columns = params.integer(h + "samples", fallback.columns, "", "rays side by side", kSamples);
  fan.min_yaw = params.number(h + "min_angle", fallback.min_yaw, "rad", "rightmost ray", kYaw);
  fan.max_yaw = params.number(h + "max_angle", fallback.max_yaw, "rad", "leftmost ray", kYaw);
  fan.rows = params.integer(v + "samples", fallback.rows, "", "rows of rays", kSamples);
  fan.min_pitch = params.number(v + "min_angle", fallback.min_pitch, "rad", "lowest row", kPitch);
  fan.max_pitch = params.number(v + "max_angle", fallback.max_pitch, "rad", "highest row", kPitch);
  fan.min = params.number("ray/range/min", fallback.min, "m", "nearer is not seen", kNotNegative);
  fan.max = params.number("ray/range/max", fallback.max, "m", "farther is not seen", kPositive);
  const std::string noise = params.choice("ray/noise/type", "gaussian", {"gaussian", "none"},
                                          "noise of each ray that meets something");
  fan.noise_mean = params.number("ray/noise/mean", fallback.noise_mean, "m", "added to a range");
  fan.noise_stddev = params.number("ray/noise/stddev", fallback.noise_stddev, "m",
                                   "standard deviation of a range", kNotNegative);
  if (noise == "none") fan.noise_mean = fan.noise_stddev = 0.0;
  check_order(params, "ray/scan/horizontal", fan.min_yaw, fan.max_yaw);
  if (fan.max_yaw - fan.min_yaw > kFullTurn) {
    throw params.error("ray/scan/horizontal", "<ray/scan/horizontal>: more than a full turn");
  }
  check_order(params, "ray/scan/vertical", fan.min_pitch, fan.max_pitch);
  check_order(params, "ray/range", fan.min, fan.max);
  return fan;
}

double greatest_difference(const Ranges& a, const Ranges& b) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    greatest = std::max(greatest, std::abs(a[i] - b[i]));
  }
  return greatest;
}

}  // namespace angen::sensors
