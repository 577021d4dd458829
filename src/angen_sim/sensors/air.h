#pragma once

#include "sensors/one_draw.h"

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
      : unit_(unit), number_(number) {
    air_.name = name;
  }

  double default_rate() const override { return 1.0; }
  void configure(Params& params, Wiring& wiring) override;
  void read(const View& view, Hits, Rng& rng, Reading& reading) override;
  Rest rest() const override { return air_.noise_stddev > 0.0 ? Rest::kNoise : Rest::kSame; }
  double quiet_chance() const override { return 1.0; }  // it tells no events
  std::shared_ptr<const Echo> echo() const override;

 private:
  /// What is read while the air stays as it is.
  struct Number : OneDraw {
    const char* name = "";
    double value = 0.0;
    double noise_stddev = 0.0;
    void tell(Rng rng, Reading& reading) const override;
  };

  const char* unit_;
  double AirHere::*number_;
  Number air_;
};

}  // namespace angen::sensors
