// libradio_transmitter.so
#include <optional>

#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/wiring.h"

namespace angen::devices {

/// A radio transmitter on its model: an id that it sends, its power, and where its antenna is.
class Transmitter : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    id_ = params.text("id", wiring.model(), "that it sends; the model's name unless given");
    power_ =
        params.number("tx_power", 0.0, "dBm", "radiated, antenna gain included", {-200.0, 100.0});
    frequency_ = params.number("frequency", 2440.0, "MHz", "of its carrier", {100.0, 100'000.0});
    position_ = params.row("position", position_, "m", "x y z of its antenna in the model's frame");
    on_ = params.flag("on", true, "sends at the start");
  }

  Verdict command(const Command& command, const View&) override {
    return Verdict::accept([this, on = command.verb == "On"] { on_ = on; });
  }

  void update(const View&, Outputs& outputs) override {
    if (was_on_ && *was_on_ != on_) outputs.event(on_ ? "on" : "off", "");
    was_on_ = on_;
  }

  Nanoseconds idle_until(const View&) const override { return kForever; }

  void save(SavedParams& params) const override { params.flag("on", on_); }

  void report(const View&, Reading& state) const override {
    state.set("on", on_);
    state.set("id", id_);
    state.set("tx_power", power_);
    state.set("frequency", frequency_);
    state.set("position", position_);
  }

 private:
  std::string id_;
  double power_ = 0.0;      // dBm
  double frequency_ = 0.0;  // MHz
  std::vector<double> position_{0.0, 0.0, 0.0};
  bool on_ = true;
  std::optional<bool> was_on_;  // none before the first update
};

ANGEN_REGISTER_PART(Transmitter, model.name + "_transmitter",
                    Kind("transmitter", "A radio transmitter on a model.")
                        .model("radio_beacon")
                        .example("set transmitter beacon1_transmitter off")
                        .verb("On", "sends")
                        .verb("Off", "sends nothing")
                        .flag("on", "whether it sends")
                        .shown_as("sends", "off")
                        .text("id", "that it sends")
                        .shown()
                        .number("tx_power", "dBm", "radiated")
                        .number("frequency", "MHz", "of its carrier")
                        .numbers("position", "m", "x y z in the model's frame"))

}  // namespace angen::devices
