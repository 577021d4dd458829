#pragma once

#include "plugin/plugin.h"
#include "sensors/pir/band_pass.h"
#include "sensors/pir/heat.h"
#include "sensors/pir/trigger.h"

namespace angen::sensors {

/// A motion detector as they are built: the heat of two elements behind a Fresnel lens, filtered,
/// compared with a threshold. Asleep while nothing warm moves in its view.
class Pyroelectric : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override;
  std::optional<RayGeometry> rays() const override { return rays_; }
  Nanoseconds sample_period() const override { return period_; }
  void aim(const View& view, RayBatch& rays) override;
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override;
  bool steady() const override;

 private:
  double filter(double flux, Rng& rng);
  bool false_alarm(Rng& rng) const;

  Heat heat_;
  RayGeometry rays_;  // for rviz
  BandPass band_;
  Trigger::Times times_;
  Trigger trigger_;
  Nanoseconds period_ = kSecond / 100;
  double noise_ = 0.0;             // V
  double threshold_ = 0.0;         // V
  double rest_ = 0.0;              // V
  double false_alarm_rate_ = 0.0;  // 1/h
  Nanoseconds last_time_ = -1;
  double flux_ = 0.0;  // W, of the last sample, without drift
  bool asleep_ = false;
};

}  // namespace angen::sensors
