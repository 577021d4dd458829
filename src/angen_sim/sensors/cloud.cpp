#include "sensors/cloud.h"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "plugin/view.h"

namespace angen::sensors {

namespace {

constexpr double kWhite = 100.0;  // the intensity of a white wall, as Velodynes are calibrated

Fan cloud_fan() {
  Fan fan;
  fan.columns = 360;
  fan.rows = 16;
  fan.min_yaw = -M_PI;
  fan.max_yaw = M_PI - 2.0 * M_PI / 360.0;
  fan.max_pitch = 15.0 * M_PI / 180.0;
  fan.min_pitch = -fan.max_pitch;
  fan.min = 0.1;
  fan.max = 100.0;
  return fan;
}

}  // namespace

void Cloud::read_rays(Params& params) {
  read_fan(params, cloud_fan());
  const double more = params.number(
      "gaussianNoise", 0.0, "m", "standard deviation of a range, beside the rays'", kNotNegative);
  fan_.noise_stddev = std::hypot(fan_.noise_stddev, more);
  fan_.declare_noise("ranges", params);
}

void Cloud::read(const View& view, Hits hits, Rng&, Reading& reading) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Ranges ranges = scan(view, hits);
  std::vector<double> intensities;
  intensities.reserve(ranges.size());
  std::map<std::uint32_t, double> known;  // by shape
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const rays::Hit& hit = hits[i];
    double intensity = 0.0;
    if (std::isfinite(ranges[i])) {
      const auto [at, is_new] = known.emplace(hit.shape, 0.0);
      if (is_new) at->second = kWhite * view.rays().reflectance(hit.shape).mean();
      intensity = at->second;
    }
    const bool seen = std::isfinite(ranges[i]) && intensity >= least_intensity_;
    if (!seen) ranges[i] = kNone;
    intensities.push_back(seen ? intensity : 0.0);
  }
  reading.set("ranges", std::move(ranges));
  reading.set("intensities", std::move(intensities));
  reading.set("columns", fan_.columns);
  reading.set("rows", fan_.rows);
  reading.set("angles",
              std::vector<double>{fan_.min_yaw, fan_.max_yaw, fan_.min_pitch, fan_.max_pitch});
  reading.set("organized", organized_);
}

Kind cloud_kind(Kind kind) {
  return kind.rate(10.0)
      .on_demand()
      .numbers("ranges", "m", "of each ray, row after row from below, infinite without a hit")
      .numbers("intensities", "", "of each ray, 100 times the albedo of the surface")
      .integer("columns", "", "rays side by side")
      .shown()
      .integer("rows", "", "of rays")
      .shown()
      .numbers("angles", "rad", "of the rightmost, leftmost, lowest and highest rays")
      .flag("organized", "its message has a place for each ray");
}

}  // namespace angen::sensors
