// libros_plugin.so
#include <memory>
#include <string>

#include "devices/part_names.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/wiring.h"

namespace angen::devices {

namespace {

constexpr char kTopic[] = "/gazebo/Light_controller";
constexpr double kEfficacy = 80.0;  // lm/W, of a household's LED lamp

}  // namespace

/// The light of a model: on, off, or dimmed in percent of its luminous flux.
class Lamp : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    full_flux_ = params.number("luminous_flux", 800.0, "lm", "luminous flux at 100 %", kPositive);
    illuminance_ =
        params.number("illuminance", 0.0, "lx",
                      "of a directional light, in place of its flux, at 100 %", kNotNegative);
    if (illuminance_ > 0.0) full_flux_ = 0.0;
    level_ = params.number("level", 0.0, "%", "level at the start", {0.0, 100.0});
    full_power_ = params.number("power", full_flux_ / kEfficacy, "W",
                                "electric power at 100 %; 80 lm/W unless given", kNotNegative);
    params.choice("topicName", kTopic, {kTopic}, "where commands come from: one topic for all");
    light_ = wiring.light(params.text("light", "", "its <light>; none: the model's only one"));
  }

  Verdict command(const Command& command, const View&) override {
    const double level = command.verb == "Dim"  ? command.number
                         : command.verb == "On" ? 100.0
                                                : 0.0;
    return Verdict::accept([this, level] { level_ = level; });
  }

  void update(const View&, Outputs& outputs) override {
    if (lit_ == level_) return;
    const bool first = lit_ < 0.0;
    const bool was_on = lit_ > 0.0;
    const bool is_on = level_ > 0.0;
    lit_ = level_;
    outputs.light(light_, level_ / 100.0, full_flux_ + illuminance_);
    if (first) return;
    outputs.event(was_on == is_on ? "dimmed" : is_on ? "on" : "off", "");
  }

  void report(const View&, Reading& state) const override {
    state.set("on", level_ > 0.0);
    state.set("level", level_);
    state.set("luminous_flux", full_flux_ * level_ / 100.0);
    state.set("power", full_power_ * level_ / 100.0);
    if (illuminance_ > 0.0) state.set("illuminance", illuminance_ * level_ / 100.0);
  }

  void save(SavedParams& params) const override { params.number("level", level_); }
  Nanoseconds idle_until(const View&) const override { return lit_ == level_ ? kForever : 0; }

 private:
  LightRef light_;
  double full_flux_ = 0.0;    // lm at 100 %
  double illuminance_ = 0.0;  // lx at 100 %, of a directional light
  double full_power_ = 0.0;   // W at 100 %
  double level_ = 0.0;        // percent
  double lit_ = -1.0;         // percent that the world was given last
};

class LampPlugin : public Plugin {
 public:
  ANGEN_DESCRIBED_AS(Kind("lamp", "A lamp.")
                         .model("ceiling_lamp")
                         .example("set lamp kitchen0 40")
                         .command_topic(kTopic)
                         .verb("On", "full brightness")
                         .verb("Off", "dark")
                         .verb("Dim", "percent", "%", {0.0, 100.0}, "of its full brightness")
                         .flag("on", "whether it is lit")
                         .shown_as("on", "off")
                         .number("level", "%", "of its full brightness")
                         .shown()
                         .number("luminous_flux", "lm", "that it emits")
                         .shown()
                         .number("power", "W", "electric power")
                         .number("illuminance", "lx", "of a directional light, facing it"))
  bool serves(const ModelInfo& model) const override { return !model.lights.empty(); }
  std::string needs() const override { return "a light"; }
  std::string instance_name(const ModelInfo& model) const override {
    return command_name(model, "lamp");
  }
  std::unique_ptr<Device> make_device() const override { return std::make_unique<Lamp>(); }
};

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::LampPlugin)
