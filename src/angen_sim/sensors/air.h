#pragma once

#include "plugin/plugin.h"

namespace angen::sensors {

struct AirHere {
  double temperature = 0.0;  // degrees Celsius
  double humidity = 0.0;     // percent
};

/// The air at the sensor: its room's, or outside of all rooms that outside. Not a number where the
/// world has no climate.
AirHere air_at(const View& view);

/// Reads one of its numbers, with noise.
class AirSensor : public Sensor {
 public:
  AirSensor(const char* name, const char* unit, double AirHere::*number)
      : name_(name), unit_(unit), number_(number) {}

  void configure(Params& params, Wiring& wiring) override;
  void read(const View& view, Hits, Rng& rng, Reading& reading) override;
  bool steady() const override { return true; }

 private:
  const char* name_;
  const char* unit_;
  double AirHere::*number_;
  double noise_stddev_ = 0.0;
};

}  // namespace angen::sensors
