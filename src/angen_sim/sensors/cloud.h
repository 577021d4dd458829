#pragma once

#include <vector>

#include "plugin/plugin.h"
#include "sensors/fan.h"

namespace angen::sensors {

/// A scanner with several rows of rays, one over the other.
class Cloud : public Sensor {
 public:
  std::optional<RayGeometry> rays() const override { return fan_; }
  int ray_set(const View&) override { return 0; }
  void aim(const View& view, RayBatch& rays) override { fan_.aim_scan(view, directions_, rays); }
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override;

 protected:
  /// Reads <ray> and <gaussianNoise>, which adds to the rays' noise.
  void read_rays(Params& params);
  Fan& fan() { return fan_; }
  bool organized_ = false;
  double least_intensity_ = 0.0;

 private:
  Fan fan_;
  std::vector<Vec3> directions_;
};

/// Adds the fields of its readings.
Kind cloud_kind(Kind kind);

}  // namespace angen::sensors
