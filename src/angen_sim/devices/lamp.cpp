#include "devices/lamp.h"

#include <optional>
#include <vector>

#include "core/text.h"
#include "devices/storeys.h"
#include "devices/words.h"
#include "plugin/register.h"

namespace angen::devices {

namespace {

constexpr double kEfficacy = 80.0;  // lm/W, of a household's LED lamp

}  // namespace

void Lamp::configure(Params& params, Wiring& wiring) {
  full_flux_ = params.number("luminous_flux", 800.0, "lm", "luminous flux at 100 %", kPositive);
  level_ = params.number("level", 0.0, "%", "level at the start", {0.0, 100.0});
  full_power_ = params.number("power", full_flux_ / kEfficacy, "W",
                              "electric power at 100 %; 80 lm/W unless given", kNotNegative);
  params.choice("topicName", "/gazebo/Light_controller", {"/gazebo/Light_controller"},
                "where commands come from: one topic for all");
  params.text("device_name", "", "the name commands use, instead of the model's and its floor");
  light_ = wiring.light("");
}

Verdict Lamp::command(const Command& command, const View&) {
  const std::vector<std::string> words = words_of(command.text);
  const auto accept = [this](double level) {
    return Verdict::accept([this, level] { level_ = level; });
  };
  if (words.size() == 1 && words[0] == "on") return accept(100.0);
  if (words.size() == 1 && words[0] == "off") return accept(0.0);
  if (words.size() == 2 && words[0] == "dim") {
    const std::optional<double> level = parse_finite(words[1]);
    if (!level || *level < 0.0 || *level > 100.0) {
      return Verdict::reject("'" + words[1] + "' is no level; Dim takes 0 to 100 percent");
    }
    return accept(*level);
  }
  return Verdict::reject("a lamp knows On, Off and Dim <percent>, not '" + command.text + "'");
}

void Lamp::update(const View&, Outputs& outputs) {
  if (lit_ == level_) return;
  const bool first = lit_ < 0.0;
  const bool was_on = lit_ > 0.0;
  const bool is_on = level_ > 0.0;
  lit_ = level_;
  outputs.light(light_, level_ / 100.0, full_flux_);
  if (first) return;
  outputs.event(was_on == is_on ? "dimmed" : is_on ? "on" : "off", "");
}

void Lamp::report(const View&, Reading& state) const {
  state.set("on", level_ > 0.0);
  state.set("level", level_);
  state.set("luminous_flux", full_flux_ * level_ / 100.0);
  state.set("power", full_power_ * level_ / 100.0);
}

std::string LampPlugin::doc() const { return "A lamp: On, Off, Dim <percent>."; }

std::string LampPlugin::instance_name(const ModelInfo& model) const {
  return command_name(model.name, "lamp", model.pose.position.z());
}

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::LampPlugin)
