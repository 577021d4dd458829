#include "sensors/fan.h"

#include <algorithm>
#include <cmath>

namespace angen::sensors {

namespace {

constexpr Range kSamples{1.0, 10000.0};
constexpr Range kPitch{-M_PI, M_PI};
constexpr Range kYaw{-2.0 * M_PI - 1e-3, 2.0 * M_PI + 1e-3};  // files round 2 pi
constexpr double kFullTurn = 2.0 * M_PI + 1e-3;

// `block` has <min…> and <max…>.
void check_order(const Params& params, const std::string& block, double first, double last) {
  if (first > last) throw params.error(block, "<" + block + ">: min is above max");
}

}  // namespace

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

Fan read_fan(Params& params, const Fan& fallback) {
  Fan fan;
  static_cast<RayGeometry&>(fan) = read_rays(params, fallback);
  const std::string noise = params.choice("ray/noise/type", "gaussian", {"gaussian", "none"},
                                          "noise of each ray that hits something");
  fan.noise_mean = params.number("ray/noise/mean", fallback.noise_mean, "m", "added to a range");
  fan.noise_stddev = params.number("ray/noise/stddev", fallback.noise_stddev, "m",
                                   "standard deviation of a range", kNotNegative);
  if (noise == "none") fan.noise_mean = fan.noise_stddev = 0.0;
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
