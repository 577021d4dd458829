#include "sensors/fan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/lists.h"
#include "plugin/view.h"

namespace angen::sensors {

constexpr double kBehind = 1e-4;  // m behind a hit on its own model, from which a ray goes on

void Fan::aim(const View& view, const std::vector<Vec3>& directions, RayBatch& rays) const {
  const Pose pose = view.pose();
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  rays.reserve(rays.size() + directions.size());
  for (const Vec3& direction : directions) {
    rays.push_back({pose.position, (rotation * direction).normalized(), min, max});
  }
}

void Fan::aim_scan(const View& view, const std::vector<Vec3>& directions, RayBatch& rays) const {
  aim(view, directions, rays);
  if (!near_blocks || min <= 0.0) return;
  near_part().aim(view, directions, rays);
}

Fan Fan::near_part() const {
  Fan part = *this;
  part.min = 0.0;
  part.max = min;
  return part;
}

namespace {

/// Sets to -infinity the range of each ray whose short one, in `open`, hits another model than the
/// sensor's own. A short ray that hits its own model goes on behind the hit.
void mark_too_near(const View& view, RayBatch open, std::vector<rays::Hit> hits, Ranges& ranges) {
  std::vector<std::size_t> numbers(open.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  const std::vector<std::uint32_t> own = view.own_shapes();
  while (!open.empty()) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (!hits[i].hit()) continue;
      if (!is_in(hits[i].shape, own)) {
        ranges[numbers[i]] = -std::numeric_limits<double>::infinity();
        continue;
      }
      open[left] = open[i];
      open[left].min = hits[i].range + kBehind;
      numbers[left++] = numbers[i];
    }
    open.resize(left);
    hits.assign(left, {});
    view.rays().cast(open, hits, rays::kAll);
  }
}

}  // namespace

Ranges Fan::scan(const View& view, const std::vector<Vec3>& directions, Hits hits) const {
  const auto last = hits.begin() + directions.size();
  Ranges ranges;
  ranges.reserve(directions.size());
  for (auto hit = hits.begin(); hit != last; ++hit) ranges.push_back(hit->range);
  if (std::any_of(last, hits.end(), [](const rays::Hit& hit) { return hit.hit(); })) {
    RayBatch near;
    near_part().aim(view, directions, near);
    mark_too_near(view, std::move(near), {last, hits.end()}, ranges);
  }
  return ranges;
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

void Scanner::read_fan(Params& params, const Fan& fallback) {
  fan_ = sensors::read_fan(params, fallback);
  fan_.near_blocks = params.flag("near_blocks", true,
                                 "a thing nearer than <min> gives no range; false: rays begin at "
                                 "<min>, as in Gazebo");
  directions_ = fan_.directions();
}

double greatest_difference(const Ranges& a, const Ranges& b) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    greatest = std::max(greatest, std::abs(a[i] - b[i]));
  }
  return greatest;
}

}  // namespace angen::sensors
