// libdaylight_plugin.so
#include <memory>
#include <string>

#include "devices/part_names.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/wiring.h"

namespace angen::devices {

constexpr double kBrightest = 100'000.0;  // lx outdoors, a clear summer noon; level 1 of its light

/// Daylight through a window: the model's light is a pane that scatters evenly into the room the
/// light that falls on it from an overcast sky.
class Daylight : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    const double area = params.number("area", 1.0, "m^2", "of the glass", kPositive);
    const double passes = params.number(
        "transmittance", 0.7, "", "share of the light that the glass lets through", {0.0, 1.0});
    const double share =
        params.number("sky_share", 0.5, "",
                      "illuminance on the pane outside over that on open ground: half of "
                      "of a uniform sky on an upright pane",
                      {0.0, 1.0});
    outdoors_ = params.number("illuminance", 0.0, "lx", "outdoors on open ground, at the start",
                              {0.0, kBrightest});
    flux_per_lux_ = area * passes * share;
    light_ = wiring.light("");
  }

  Verdict command(const Command& command, const View&) override {
    return Verdict::accept([this, outdoors = command.number] { outdoors_ = outdoors; });
  }

  void update(const View&, Outputs& outputs) override {
    if (given_ == outdoors_) return;
    const bool first = given_ < 0.0;
    given_ = outdoors_;
    outputs.light(light_, outdoors_ / kBrightest, kBrightest * flux_per_lux_);
    if (!first) outputs.event("changed", "");
  }

  Nanoseconds idle_until(const View&) const override { return kForever; }

  void save(SavedParams& params) const override { params.number("illuminance", outdoors_); }

  void report(const View&, Reading& state) const override {
    state.set("illuminance", outdoors_);
    state.set("luminous_flux", flux_per_lux_ * outdoors_);
  }

 private:
  LightRef light_;
  double flux_per_lux_ = 0.0;  // lm into the room for each lx outdoors
  double outdoors_ = 0.0;      // lx
  double given_ = -1.0;        // lx that the world was given last
};

class DaylightPlugin : public Plugin {
 public:
  ANGEN_DESCRIBED_AS(Kind("daylight", "Daylight through a window.")
                         .model("daylight_window")
                         .example("set daylight window0 10000")
                         .verb("Set", "lux", "lx", {0.0, kBrightest}, "illuminance outdoors")
                         .number("illuminance", "lx", "outdoors")
                         .shown()
                         .number("luminous_flux", "lm", "through the window"))
  bool serves(const ModelInfo& model) const override { return !model.lights.empty(); }
  std::string instance_name(const ModelInfo& model) const override {
    return command_name(model, "window");
  }
  std::unique_ptr<Device> make_device() const override { return std::make_unique<Daylight>(); }
};

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::DaylightPlugin)
