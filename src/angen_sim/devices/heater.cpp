#include <optional>

#include "core/text.h"
#include "devices/words.h"
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
    const std::vector<std::string> words = words_of(command.text);
    std::optional<double> level;
    if (words.size() == 1 && words[0] == "on") level = 100.0;
    if (words.size() == 1 && words[0] == "off") level = 0.0;
    if (words.size() == 2 && words[0] == "set") level = parse_finite(words[1]);
    if (!level || *level < 0.0 || *level > 100.0) {
      return Verdict::reject("a heater knows On, Off and Set <0 to 100 percent>, not '" +
                             command.text + "'");
    }
    return Verdict::accept([this, level = *level] { level_ = level; });
  }

  void update(const View&, Outputs& outputs) override {
    if (told_ && *told_ != level_) {
      const bool same = (*told_ > 0.0) == (level_ > 0.0);
      outputs.event(same ? "set" : level_ > 0.0 ? "on" : "off", "");
    }
    told_ = level_;
  }

  void save(SavedParams& params) const override { params.number("level", level_); }

  Nanoseconds idle_until(const View&) const override { return kForever; }

  void report(const View&, Reading& state) const override {
    state.set("on", level_ > 0.0);
    state.set("level", level_);
    state.set("power", full_power_ * level_ / 100.0);
  }

 private:
  double full_power_ = 0.0;     // W at 100 %
  double level_ = 0.0;          // percent
  std::optional<double> told_;  // percent, none before the first update
};

class HeaterPlugin : public Plugin {
 public:
  std::string kind() const override { return "heater"; }
  std::string doc() const override { return "An electric heater: On, Off, Set <percent>."; }
  bool serves(const ModelInfo&) const override { return true; }
  std::unique_ptr<Device> make_device() const override { return std::make_unique<Heater>(); }
};

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::HeaterPlugin)
