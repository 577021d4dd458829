#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "plugin/register.h"
#include "sensors/one_draw.h"

namespace angen::sensors {

namespace {

/// What falls on the face; as an echo, what is read while that stays.
struct Incident : OneDraw {
  light::Sample sample;
  double noise_stddev = 0.0;  // relative

  void tell(Rng rng, Reading& reading) const override {
    const double noise = noise_stddev > 0.0 ? noise_stddev * rng.gaussian() : 0.0;
    reading.set("illuminance", std::max(0.0, sample.illuminance * (1.0 + noise)));
    reading.set("r", static_cast<double>(sample.color.x()));
    reading.set("g", static_cast<double>(sample.color.y()));
    reading.set("b", static_cast<double>(sample.color.z()));
  }
};

}  // namespace

/// A light sensor that looks along its x axis: illuminance on its face, and the mean colour it
/// sees.
class Luminosity : public Sensor {
 public:
  double default_rate() const override { return 1.0; }

  void configure(Params& params, Wiring&) override {
    light_.noise_stddev =
        params.number("noise_stddev", 0.0, "", "of the illuminance, relative to it", kNotNegative);
  }

  void read(const View& view, Hits, Rng& rng, Reading& reading) override {
    light_.sample = view.illuminance(probe_, view.pose());
    light_.tell(rng, reading);
    tell_change(light_.sample.illuminance, reading);
  }

  /// Noise is relative: in the dark there is none.
  Rest rest() const override {
    return light_.noise_stddev > 0.0 && light_.sample.illuminance > 0.0 ? Rest::kNoise
                                                                        : Rest::kSame;
  }
  double quiet_chance() const override { return 1.0; }  // events tell what it is without noise
  std::shared_ptr<const Echo> echo() const override { return std::make_shared<Incident>(light_); }

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

  Incident light_;
  light::Probe probe_;
  std::optional<double> told_;  // lx without noise
};

ANGEN_REGISTER_SENSOR(Luminosity, "luminosity", "Illuminance in lux and the mean colour of a view.")

}  // namespace angen::sensors
