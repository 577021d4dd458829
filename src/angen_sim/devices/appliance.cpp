// libappliance.so
#include <cmath>
#include <optional>

#include "devices/sound.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/wiring.h"

namespace angen::devices {

namespace {

/// Dependence of power and sound on the level: both in powers of it.
struct Control {
  const char* name;
  double power_exponent;
  double sound_exponent;
};

// A fan's shaft power is as the cube of its speed, its sound power as about the fifth power. Volume
// is the amplitude of an amplifier's output, whose power is as the square.
constexpr Control kControls[] = {{"none", 0.0, 0.0}, {"speed", 3.0, 5.0}, {"volume", 2.0, 2.0}};

}  // namespace

/// A fan, a television, a stereo: on or off, with a speed or a volume, or with neither. Its
/// electric power and its sound power follow from these.
class Appliance : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    const std::string control =
        params.choice("control", "none", {"none", "speed", "volume"}, "meaning of its level");
    for (const Control& known : kControls) {
      if (control == known.name) control_ = known;
    }
    full_power_ =
        params.number("power", 50.0, "W", "electric power at full speed or volume", kPositive);
    idle_power_ = params.number("idle_power", 0.0, "W", "on, at speed or volume 0", kNotNegative);
    if (idle_power_ > full_power_) {
      throw params.error("idle_power", "idle_power is above power, which includes it");
    }
    standby_power_ = params.number("standby_power", 0.0, "W", "switched off", kNotNegative);
    full_sound_.configure(params, 60.0, "at full speed or volume, over 1 pW");
    flux_ = params.number("luminous_flux", 0.0, "lm",
                          "of the model's light while it is on; 0 = it has none", kNotNegative);
    level_ = params.number("level", 50.0, "%", "speed or volume at the start", {0.0, 100.0});
    on_ = params.flag("on", false, "switched on at the start");
    if (flux_ > 0.0) light_ = wiring.light("");
  }

  Verdict command(const Command& command, const View&) override {
    if (command.verb == "On" || command.verb == "Off") {
      return Verdict::accept([this, on = command.verb == "On"] { on_ = on; });
    }
    const std::string needed = command.verb == "Speed" ? "speed" : "volume";
    if (needed != control_.name) {
      const std::string has = control_.name;
      return Verdict::reject("this appliance has no " + needed +
                             (has == "none" ? "; it takes On and Off" : ", but a " + has));
    }
    return Verdict::accept([this, level = command.number] { level_ = level; });
  }

  void update(const View&, Outputs& outputs) override {
    const bool switched = was_on_ && *was_on_ != on_;
    if (switched) {
      outputs.event(on_ ? "on" : "off", "");
    } else if (was_on_ && last_level_ != level_) {
      outputs.event("set", "");
    }
    if (flux_ > 0.0 && was_on_ != on_) outputs.light(light_, on_ ? 1.0 : 0.0, flux_);
    was_on_ = on_;
    last_level_ = level_;
  }

  Nanoseconds idle_until(const View&) const override { return kForever; }

  void save(SavedParams& params) const override {
    params.flag("on", on_);
    params.number("level", level_);
  }

  void report(const View&, Reading& state) const override {
    state.set("on", on_);
    state.set("level", level_);
    state.set("power", power());
    full_sound_.report(sound(), state);
  }

 private:
  double power() const {
    if (!on_) return standby_power_;
    const double share = std::pow(level_ / 100.0, control_.power_exponent);
    return idle_power_ + (full_power_ - idle_power_) * share;
  }

  double sound() const {
    if (!on_) return Sound::kSilent;
    return full_sound_.level() +
           10.0 * std::log10(std::pow(level_ / 100.0, control_.sound_exponent));
  }

  Control control_ = kControls[0];
  double full_power_ = 0.0;     // W
  double idle_power_ = 0.0;     // W
  double standby_power_ = 0.0;  // W
  Sound full_sound_;
  double flux_ = 0.0;  // lm
  LightRef light_;
  bool on_ = false;
  double level_ = 0.0;          // percent
  std::optional<bool> was_on_;  // none before the first update
  double last_level_ = 0.0;     // percent
};

ANGEN_REGISTER_DEVICE(
    Appliance,
    Sound::describe(Kind("appliance", "A fan, a television, a stereo: power and sound.")
                        .model("fan")
                        .model("tv")
                        .model("stereo")
                        .example("set appliance fan1 speed 70")
                        .verb("On", "at its level")
                        .verb("Off", "on standby")
                        .verb("Speed", "percent", "%", {0.0, 100.0}, "of a fan, of its full speed")
                        .verb("Volume", "percent", "%", {0.0, 100.0}, "of a television or stereo")
                        .flag("on", "whether it is on")
                        .shown_as("on", "off")
                        .number("level", "%", "speed or volume that it has while it is on")
                        .shown()
                        .number("power", "W", "electric power, all of which becomes heat")
                        .shown(1)))

}  // namespace angen::devices
