#pragma once

#include "sensors/fan.h"

namespace angen::sensors {

/// A scanner with several rows of rays, one over the other.
class Cloud : public Scanner {
 public:
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override;

 protected:
  /// Reads <ray> and <gaussianNoise>, which adds to the rays' noise.
  void read_rays(Params& params);
  bool organized_ = false;
  double least_intensity_ = 0.0;
};

/// Adds the fields of its readings.
Kind cloud_kind(Kind kind);

}  // namespace angen::sensors
