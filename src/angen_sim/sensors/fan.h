#pragma once

#include <vector>

#include "core/random.h"
#include "plugin/params.h"
#include "plugin/plugin.h"
#include "plugin/ray_geometry.h"

namespace angen::sensors {

/// One scan: a range for each ray in meters, the greatest range where nothing was hit.
using Ranges = std::vector<double>;

/// The rays of an SDF <ray> block and their noise.
struct Fan : RayGeometry {
  double noise_mean = 0.0;  // m, of a hit's range
  double noise_stddev = 0.0;

  bool near_blocks = true;  // a thing nearer than `min` hides what is behind it

  /// `directions` as rays of the sensor that has the view.
  void aim(const View& view, const std::vector<Vec3>& directions, RayBatch& rays) const;

  /// The same for scan(): after these rays come as many short ones, for what is too near.
  void aim_scan(const View& view, const std::vector<Vec3>& directions, RayBatch& rays) const;

  /// The hits of aim_scan() as ranges in m: infinite without a hit, and -infinite if something is
  /// nearer than `min` that does not belong to the sensor's own model (REP 117).
  Ranges scan(const View& view, const std::vector<Vec3>& directions, Hits hits) const;

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

  /// The noise of with_noise() that is within ±limit (m) of its mean at each of `rays` rays.
  QuietNoise quiet_within(double limit, std::size_t rays) const {
    return {noise_stddev > 0.0 ? chance_within(rays, limit / noise_stddev) : 1.0};
  }

 private:
  Fan near_part() const;  // from the sensor to `min`
};

/// Reads <scan>, <range> and <noise> of <ray>; `fallback` has the default values.
Fan read_fan(Params& params, const Fan& fallback);

/// A sensor whose rays are a fan: each sample is a scan of them.
class Scanner : public Sensor {
 public:
  std::optional<RayGeometry> rays() const override { return fan_; }
  int ray_set(const View&) override { return 0; }
  void aim(const View& view, RayBatch& rays) override { fan_.aim_scan(view, directions_, rays); }

 protected:
  /// Reads <ray> and <near_blocks>; `fallback` has the default values of <ray>.
  void read_fan(Params& params, const Fan& fallback);
  Ranges scan(const View& view, Hits hits) const { return fan_.scan(view, directions_, hits); }

  Fan fan_;

 private:
  std::vector<Vec3> directions_;
};

/// The greatest |a[i] - b[i]| in meters.
double greatest_difference(const Ranges& a, const Ranges& b);

}  // namespace angen::sensors
