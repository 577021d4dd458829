#pragma once

#include "plugin/plugin.h"
#include "plugin/rooms.h"

namespace angen::sensors {

/// Reads one number of the air in its room, with noise.
class AirSensor : public Sensor {
 public:
  AirSensor(const char* name, const char* unit, double AirHere::*number)
      : name_(name), unit_(unit), number_(number) {}

  void configure(Params& params, Wiring& wiring) override;
  void read(const View& view, Hits, Rng& rng, Reading& reading) override;
  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 private:
  const char* name_;
  const char* unit_;
  double AirHere::*number_;
  double noise_stddev_ = 0.0;
};

}  // namespace angen::sensors
