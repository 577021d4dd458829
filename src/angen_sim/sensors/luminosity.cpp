#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "plugin/register.h"

namespace angen::sensors {

/// A light sensor that looks along its x axis: illuminance on its face, and the mean colour it
/// sees.
class Luminosity : public Sensor {
 public:
  double default_rate() const override { return 1.0; }

  void configure(Params& params, Wiring&) override {
    noise_stddev_ =
        params.number("noise_stddev", 0.0, "", "of the illuminance, relative to it", kNotNegative);
  }

  void read(const View& view, Hits, Rng& rng, Reading& reading) override {
    const light::Sample sample = view.illuminance(probe_, view.pose());
    const double noise = noise_stddev_ > 0.0 ? noise_stddev_ * rng.gaussian() : 0.0;
    reading.set("illuminance", std::max(0.0, sample.illuminance * (1.0 + noise)));
    reading.set("r", static_cast<double>(sample.color.x()));
    reading.set("g", static_cast<double>(sample.color.y()));
    reading.set("b", static_cast<double>(sample.color.z()));
    tell_change(sample.illuminance, reading);
  }

  Rest rest() const override { return noise_stddev_ > 0.0 ? Rest::kNoise : Rest::kSame; }
  bool quiet(Rng) const override { return true; }  // events are told of what it is without noise

 private:
  static constexpr double kRelativeChange = 0.15;  // of what was told last; CASAS' sensors do so
  static constexpr double kLeastChange = 0.01;     // lx: darkness has no relative changes

  void tell_change(double illuminance, Reading& reading) {
    if (!told_) told_ = illuminance;
    const double change = std::abs(illuminance - *told_);
    if (change < std::max(kRelativeChange * *told_, kLeastChange)) return;
    std::ostringstream detail;
    detail << "from " << *told_ << " to " << illuminance << " lx";
    reading.event = "changed";
    reading.event_detail = detail.str();
    told_ = illuminance;
  }

  double noise_stddev_ = 0.0;
  light::Probe probe_;
  std::optional<double> told_;  // lx without noise
};

ANGEN_REGISTER_SENSOR(Luminosity, "luminosity", "Illuminance in lux and the mean colour of a view.")

}  // namespace angen::sensors
