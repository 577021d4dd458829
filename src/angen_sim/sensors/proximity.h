#pragma once

#include "sensors/fan.h"

namespace angen::sensors {

/// The distance to the nearest thing in a narrow cone, as an ultrasonic or infrared ranger
/// measures it.
class Proximity : public Scanner {
 public:
  void configure(Params& params, Wiring& wiring) override;
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override;
  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 protected:
  /// Reads <ray> and the noise; the cone is as wide as its rays.
  void read_rays(Params& params);
  double field_of_view_ = 0.0;  // rad
  bool infrared_ = false;
};

Kind proximity_kind(Kind kind);

}  // namespace angen::sensors
