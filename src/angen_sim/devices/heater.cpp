// libheater.so
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "devices/approach.h"
#include "devices/refresh.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/rooms.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::devices {

namespace {

constexpr double kSameAir = 0.02;  // K
constexpr double kAirRate = 0.1;   // Hz: how often it follows the air of its room

}  // namespace

/// An electric heater: its electric power is heat in its room, and its casing warms.
class Heater : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    full_power_ = params.number("power", 1000.0, "W", "electric power at 100 %", kPositive);
    level_ = params.number("level", 0.0, "%", "level at the start", {0.0, 100.0});
    full_rise_ = params.number("surface_rise", 40.0, "K",
                               "its surface is warmer than the air at 100 %", {0.0, 1000.0});
    heat_.time_constant =
        params.number("surface_time_constant", 300.0, "s", "of its warming", {0.0, 1e6});
    start_rise_ = params.number("surface_start", full_rise_ * level_ / 100.0, "K",
                                "by which its surface is warmer at the start; as after a long "
                                "time at its level unless given",
                                {-1000.0, 1000.0});
    const std::string visual =
        params.text("surface", "", "the visual that warms; all of the model unless given");
    surfaces_ = wiring.surfaces(visual);
  }

  Verdict command(const Command& command, const View&) override {
    const double level = command.verb == "Set"  ? command.number
                         : command.verb == "On" ? 100.0
                                                : 0.0;
    return Verdict::accept([this, level] { level_ = level; });
  }

  void update(const View& view, Outputs& outputs) override {
    heat_.advance(to_seconds(view.step()));
    const bool other_air = feel_air(view);
    if (other_air || last_level_ != level_) warm(outputs);
    if (last_level_ && *last_level_ != level_) {
      const bool same = (*last_level_ > 0.0) == (level_ > 0.0);
      outputs.event(same ? "set" : level_ > 0.0 ? "on" : "off", "");
    }
    last_level_ = level_;
  }

  void skip(Nanoseconds time) override { heat_.advance(to_seconds(time)); }

  void save(SavedParams& params) const override {
    params.number("level", level_);
    params.number("surface_start", unknown_air_ > 0 ? start_rise_ : heat_.value - air_);
  }

  Nanoseconds idle_until(const View& view) const override {
    if (unknown_air_ > 0) return 0;
    return climates(view).empty() ? kForever : air_due_.next(view.time());
  }

  void report(const View&, Reading& state) const override {
    state.set("on", level_ > 0.0);
    state.set("level", level_);
    state.set("power", full_power_ * level_ / 100.0);
  }

 private:
  // Whether the air of its room is another one.
  bool feel_air(const View& view) {
    if (!air_due_.due(view.time(), view.step()) && unknown_air_ == 0) return false;
    const double air = air_temperature(view, view.pose().position);
    const bool starts = unknown_air_ > 0;
    if (starts) {
      --unknown_air_;
      heat_.value = air + start_rise_;
    }
    if (!starts && std::abs(air - air_) < kSameAir) return false;
    air_ = air;
    return true;
  }

  void warm(Outputs& outputs) {
    heat_.limit = air_ + full_rise_ * level_ / 100.0;
    for (const SurfaceRef surface : surfaces_) {
      outputs.temperature(surface, heat_.value, heat_.limit, heat_.time_constant);
    }
  }

  double full_power_ = 0.0;  // W at 100 %
  double full_rise_ = 0.0;   // K at 100 %
  double start_rise_ = 0.0;  // K, of its surface over the air
  Approach heat_;            // K, of its surface
  double air_ = 0.0;         // K
  int unknown_air_ = 2;      // updates, until a climate has reported the air that it starts at
  Refresh air_due_{kAirRate};
  std::vector<SurfaceRef> surfaces_;
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
