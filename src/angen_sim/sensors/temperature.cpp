#include "plugin/register.h"
#include "sensors/air.h"

namespace angen::sensors {

/// The temperature of the air in the room that it is in.
class Temperature : public Sensor {
 public:
  double default_rate() const override { return 1.0; }

  void configure(Params& params, Wiring&) override {
    noise_stddev_ = params.number("noise_stddev", 0.0, "degC", "of a reading", kNotNegative);
  }

  void read(const View& view, Hits, Rng& rng, Reading& reading) override {
    const double noise = noise_stddev_ > 0.0 ? noise_stddev_ * rng.gaussian() : 0.0;
    reading.set("temperature", air_at(view).temperature + noise);
    reading.set("variance", noise_stddev_ * noise_stddev_);
  }

  Rest rest() const override { return noise_stddev_ > 0.0 ? Rest::kNoise : Rest::kSame; }
  bool quiet(Rng) const override { return true; }  // it tells no events

 private:
  double noise_stddev_ = 0.0;  // degC
};

ANGEN_REGISTER_SENSOR(Temperature, "temperature", "The temperature of the air in its room.")

}  // namespace angen::sensors
