#include <optional>

#include "plugin/register.h"

namespace angen::devices {

/// An electric heater: what it takes from its socket is heat in its room.
class Heater : public Device {
 public:
  void configure(Params& params, Wiring&) override {
    full_power_ = params.number("power", 1000.0, "W", "electric power at 100 %", kPositive);
    level_ = params.number("level", 0.0, "%", "level at the start", {0.0, 100.0});
    params.text("device_name", "", "the name commands use, instead of the model's");
  }

  Verdict command(const Command& command, const View&) override {
    const double level = command.verb == "Set"  ? command.number
                         : command.verb == "On" ? 100.0
                                                : 0.0;
    return Verdict::accept([this, level] { level_ = level; });
  }

  void update(const View&, Outputs& outputs) override {
    if (last_level_ && *last_level_ != level_) {
      const bool same = (*last_level_ > 0.0) == (level_ > 0.0);
      outputs.event(same ? "set" : level_ > 0.0 ? "on" : "off", "");
    }
    last_level_ = level_;
  }

  void save(SavedParams& params) const override { params.number("level", level_); }

  Nanoseconds idle_until(const View&) const override { return kForever; }

  void report(const View&, Reading& state) const override {
    state.set("on", level_ > 0.0);
    state.set("level", level_);
    state.set("power", full_power_ * level_ / 100.0);
  }

 private:
  double full_power_ = 0.0;           // W at 100 %
  double level_ = 0.0;                // percent
  std::optional<double> last_level_;  // percent, none before the first update
};

ANGEN_REGISTER_DEVICE(Heater, Kind("heater", "An electric heater.")
                                  .model("heater")
                                  .example("set heater heater1 40")
                                  .verb("On", "full power")
                                  .verb("Off", "no power")
                                  .verb("Set", "percent", "%", {0.0, 100.0}, "of its full power")
                                  .flag("on", "whether it heats")
                                  .shown_as("on", "off")
                                  .number("level", "%", "of its full power")
                                  .shown()
                                  .number("power", "W", "electric power, which heats the room")
                                  .shown())

}  // namespace angen::devices
