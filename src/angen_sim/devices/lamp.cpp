// libros_plugin.so
#include "devices/lamp.h"

#include "devices/part_names.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/wiring.h"

namespace angen::devices {

namespace {

constexpr char kTopic[] = "/gazebo/Light_controller";
constexpr double kEfficacy = 80.0;  // lm/W, of a household's LED lamp

}  // namespace

void Lamp::configure(Params& params, Wiring& wiring) {
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

Verdict Lamp::command(const Command& command, const View&) {
  const double level = command.verb == "Dim" ? command.number : command.verb == "On" ? 100.0 : 0.0;
  return Verdict::accept([this, level] { level_ = level; });
}

void Lamp::update(const View&, Outputs& outputs) {
  if (lit_ == level_) return;
  const bool first = lit_ < 0.0;
  const bool was_on = lit_ > 0.0;
  const bool is_on = level_ > 0.0;
  lit_ = level_;
  outputs.light(light_, level_ / 100.0, full_flux_ + illuminance_);
  if (first) return;
  outputs.event(was_on == is_on ? "dimmed" : is_on ? "on" : "off", "");
}

void Lamp::report(const View&, Reading& state) const {
  state.set("on", level_ > 0.0);
  state.set("level", level_);
  state.set("luminous_flux", full_flux_ * level_ / 100.0);
  state.set("power", full_power_ * level_ / 100.0);
  if (illuminance_ > 0.0) state.set("illuminance", illuminance_ * level_ / 100.0);
}

const Kind& LampPlugin::kind() const {
  static const Kind kind = Kind("lamp", "A lamp.")
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
                               .number("illuminance", "lx", "of a directional light, facing it");
  return kind;
}

std::string LampPlugin::instance_name(const ModelInfo& model) const {
  return command_name(model, "lamp");
}

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::LampPlugin)
