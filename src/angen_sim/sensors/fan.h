#pragma once

#include <vector>

#include "core/random.h"
#include "plugin/params.h"
#include "plugin/view.h"

namespace angen::sensors {

/// One scan: a range a ray in meters, the greatest range where nothing was met.
using Ranges = std::vector<double>;

/// The rays of an SDF <ray> block and their noise.
struct Fan {
  int columns = 1;
  int rows = 1;
  double min_yaw = 0.0;  // rad, positive to the left
  double max_yaw = 0.0;
  double min_pitch = 0.0;  // rad, positive upwards
  double max_pitch = 0.0;
  double min = 0.0;  // m
  double max = 0.0;
  double noise_mean = 0.0;  // m, of a hit's range
  double noise_stddev = 0.0;

  std::size_t size() const { return static_cast<std::size_t>(columns) * rows; }

  /// Unit vectors in the sensor's frame (x forward, z up), row after row from below; the whole fan
  /// turned upwards by `pitch` rad.
  std::vector<Vec3> directions(double pitch = 0.0) const;

  /// `directions` as rays of the sensor at `pose` (world).
  void aim(const Pose& pose, const std::vector<Vec3>& directions, RayBatch& rays) const;

  /// The scan that `hits` are, without noise.
  Ranges measure(Hits hits) const;

  /// A scan with noise where something was met. Noise takes no range below `min` or above `max`.
  Ranges with_noise(Ranges ranges, Rng rng) const;

  /// The same noise for a reading's field of ranges that are infinite where nothing was met: the
  /// simulator adds it, ray after ray.
  void declare_noise(const std::string& field, Params& params) const {
    params.noise({field, noise_mean, noise_stddev, {min, max}, false});
  }

  bool noisy() const { return noise_mean != 0.0 || noise_stddev > 0.0; }

  /// with_noise() keeps noise within ±limit (m) of its mean at every ray where the first uniform()
  /// of its random numbers is below this.
  double quiet_chance(double limit) const { return quiet_chance(limit, size()); }

  /// The same for a scan of so many rays.
  double quiet_chance(double limit, std::size_t rays) const {
    return noise_stddev > 0.0 ? chance_within(rays, limit / noise_stddev) : 1.0;
  }
};

/// Reads <ray>; `fallback` stands for what it leaves out.
Fan read_fan(Params& params, const Fan& fallback);

/// The greatest |a[i] - b[i]| in meters.
double greatest_difference(const Ranges& a, const Ranges& b);

}  // namespace angen::sensors
