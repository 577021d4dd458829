// libpir_controller.so
#include <memory>
#include <string>

#include "plugin/registration.h"
#include "sensors/pir/pyroelectric.h"
#include "sensors/pir/range_difference.h"

namespace angen::sensors {

/// A motion detector, by one of two models.
class PirPlugin : public Plugin {
 public:
  ANGEN_DESCRIBED_AS(describe())
  std::unique_ptr<Sensor> make_sensor(Params& params) const override {
    const std::string model =
        params.choice("model", kRanges, {kRanges, kHeat}, "how it detects motion");
    if (model == kHeat) return std::make_unique<Pyroelectric>();
    return std::make_unique<RangeDifference>();
  }

 private:
  static constexpr const char* kRanges = "range_difference";
  static constexpr const char* kHeat = "pyroelectric";

  static Kind describe() {
    return Kind("pir", "A motion detector: range differences, or heat as a real one.")
        .model("pir")
        .model("pir_pyroelectric", "model", kHeat)
        .example("spawn pir p1 --pose \"1 1 1.2 0 0 0\" --set ray/range/max=4")
        .ray_color("0 0 1 0.45")
        .flag("motion", "whether it detects motion")
        .alarm("MOTION", "still")
        .events("motion", "still")
        .flag("departure", "of one that nods: something has left since the last nod, no motion now")
        .with("model", kRanges)
        .number("difference", "m", "greatest, of a range from the one a sample before")
        .with("model", kRanges)
        .shown(3)
        .number("threshold", "m", "as its parameter")
        .with("model", kRanges)
        .number("signal", "m", "the difference")
        .with("model", kRanges)
        .number("signal", "V", "of the elements")
        .with("model", kHeat)
        .number("signal_threshold", "m", "the threshold")
        .with("model", kRanges)
        .number("signal_threshold", "V", "as its parameter")
        .with("model", kHeat)
        .number("flux", "W", "on the elements")
        .with("model", kHeat)
        .numbers("ranges", "m", "of each ray")
        .with("model", kRanges);
  }
};

ANGEN_REGISTER_PLUGIN(PirPlugin)

}  // namespace angen::sensors
