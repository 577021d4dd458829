#pragma once

#include <vector>

#include "core/random.h"
#include "plugin/params.h"
#include "plugin/ray_geometry.h"
#include "plugin/view.h"

namespace angen::sensors {

/// One scan: a range for each ray in meters, the greatest range where nothing was hit.
using Ranges = std::vector<double>;

/// The rays of an SDF <ray> block and their noise.
struct Fan : RayGeometry {
  double noise_mean = 0.0;  // m, of a hit's range
  double noise_stddev = 0.0;

  /// `directions` as rays of the sensor at `pose` (world).
  void aim(const Pose& pose, const std::vector<Vec3>& directions, RayBatch& rays) const;

  /// The scan that `hits` are, without noise.
  Ranges measure(Hits hits) const;

  /// A scan with noise where a ray hit something. Noise takes no range below `min` or above `max`.
  Ranges with_noise(Ranges ranges, Rng rng) const;

  /// Declares the noise of a reading's field of ranges that are infinite without a hit: the
  /// simulator adds it, ray after ray.
  void declare_noise(const std::string& field, Params& params) const {
    params.noise({field, noise_mean, noise_stddev, {min, max}, false});
  }

  bool noisy() const { return noise_mean != 0.0 || noise_stddev > 0.0; }

  /// with_noise() keeps noise within ±limit (m) of its mean at every ray where the first uniform()
  /// of its random numbers is below this.
  double no_event_probability(double limit) const { return no_event_probability(limit, size()); }

  /// That probability for a scan of `rays` rays.
  double no_event_probability(double limit, std::size_t rays) const {
    return noise_stddev > 0.0 ? chance_within(rays, limit / noise_stddev) : 1.0;
  }
};

/// Reads <scan>, <range> and <noise> of <ray>; `fallback` has the default values.
Fan read_fan(Params& params, const Fan& fallback);

/// The greatest |a[i] - b[i]| in meters.
double greatest_difference(const Ranges& a, const Ranges& b);

}  // namespace angen::sensors
