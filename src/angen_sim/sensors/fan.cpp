#include "sensors/fan.h"

#include <algorithm>
#include <cmath>

namespace angen::sensors {

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
