// libluminosity_sensor_controller.so libluminosity_sensor_utils.so
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/text.h"
#include "plugin/registration.h"
#include "plugin/view.h"

namespace angen::sensors {

/// A light sensor that looks along its x axis: illuminance on its face, and the mean color it
/// sees.
class Luminosity : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    params.noise("illuminance", "", "of the illuminance, relative to it", true);
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const light::Sample sample = view.illuminance(probe_, view.pose());
    reading.set("illuminance", sample.illuminance);
    reading.set("r", static_cast<double>(sample.color.x()));
    reading.set("g", static_cast<double>(sample.color.y()));
    reading.set("b", static_cast<double>(sample.color.z()));
    note_change(sample.illuminance, reading);
  }

  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 private:
  static constexpr double kRelativeChange = 0.15;  // share of the last event's value, as CASAS
  static constexpr double kLeastChange = 0.01;     // lx: darkness has no relative changes

  void note_change(double illuminance, Reading& reading) {
    if (!noted_) noted_ = illuminance;
    const double change = std::abs(illuminance - *noted_);
    if (change < std::max(kRelativeChange * *noted_, kLeastChange)) return;
    reading.event = "changed";
    reading.event_detail = text_of("from ", *noted_, " to ", illuminance, " lx");
    noted_ = illuminance;
  }

  light::Probe probe_;
  std::optional<double> noted_;  // lx without noise
};

ANGEN_REGISTER_SENSOR(
    Luminosity,
    Kind("luminosity", "Illuminance in lux and the mean color of a view.")
        .rate(1.0)
        .model("luminosity_sensor")
        .example("spawn luminosity l1 --pose \"2 0.1 2.2 0 0 1.57\" --set update_rate=5")
        .number("illuminance", "lx", "on its face")
        .shown(2)
        .number("r", "", "red of the mean color, 0 to 1")
        .number("g", "", "green of it")
        .number("b", "", "blue of it"))

}  // namespace angen::sensors
