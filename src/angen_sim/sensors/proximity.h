#pragma once

#include "plugin/plugin.h"
#include "sensors/fan.h"

namespace angen::sensors {

/// The distance to the nearest thing in a narrow cone, as an ultrasonic or infrared ranger
/// measures it.
class Proximity : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override;
  std::optional<RayGeometry> rays() const override { return fan_; }
  int ray_set(const View&) override { return 0; }
  void aim(const View& view, RayBatch& rays) override { fan_.aim_scan(view, directions_, rays); }
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override;
  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 protected:
  /// Reads <ray> and the noise; the cone is as wide as its rays.
  void read_rays(Params& params);
  double field_of_view_ = 0.0;  // rad
  bool infrared_ = false;

  const Fan& fan() const { return fan_; }

 private:
  Fan fan_;
  std::vector<Vec3> directions_;
};

Kind proximity_kind(Kind kind);

}  // namespace angen::sensors
