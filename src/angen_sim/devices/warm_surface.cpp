// libwarm_surface.so
#include <string>
#include <utility>
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

constexpr double kRate = 1.0;  // Hz: how often its state is renewed while it changes
constexpr Range kKelvin{1.0, 5000.0};
constexpr double kThere = 1e-3;  // K from its target: from then on it is there

}  // namespace

/// A surface whose temperature is commanded: a radiator, a kettle, a patch of sunshine. PIRs see
/// it.
class WarmSurface : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    std::vector<std::string> visuals =
        params.texts("surface", "", "a visual that warms; all of the model unless given");
    if (visuals.empty()) visuals.emplace_back();
    for (const std::string& visual : visuals) {
      const std::vector<SurfaceRef> found = wiring.surfaces(visual);
      surfaces_.insert(surfaces_.end(), found.begin(), found.end());
    }
    const double start = params.number("temperature", 295.15, "K",
                                       "at the start; as the air around unless given", kKelvin);
    if (params.has("temperature")) unknown_air_ = 0;
    targeted_ = params.has("target");
    const double target =
        params.number("target", start, "K", "its target; as at the start unless given", kKelvin);
    heat_ = {start, target,
             params.number("time_constant", 60.0, "s", "of its approach to the target; 0 = at once",
                           {0.0, 1e6})};
  }

  Verdict command(const Command& command, const View& view) override {
    const double target = command.verb == "Temperature" ? command.number : air(view);
    return Verdict::accept([this, target] {
      heat_.limit = target;
      targeted_ = true;
      set_ = false;
    });
  }

  void update(const View& view, Outputs& outputs) override {
    const bool first = std::exchange(first_, false);
    if (unknown_air_ > 0) {
      --unknown_air_;
      heat_.value = air(view);
      set_ = false;
    }
    if (!targeted_) heat_.limit = heat_.value;
    if (!first) {
      heat_.advance(to_seconds(view.step()));
    }
    if (!std::exchange(set_, true)) {
      for (const SurfaceRef surface : surfaces_) {
        outputs.temperature(surface, heat_.value, heat_.limit, heat_.time_constant);
      }
    }
    const bool was = std::exchange(changes_, std::abs(heat_.value - heat_.limit) >= kThere);
    if (!changes_) heat_.value = heat_.limit;
    if (was != changes_) outputs.event(changes_ ? "changes" : "steady", "");
  }

  void skip(Nanoseconds time) override { heat_.advance(to_seconds(time)); }

  Nanoseconds idle_until(const View& view) const override {
    if (unknown_air_ > 0) return 0;
    return changes_ ? due_.next(view.time()) : kForever;
  }

  void save(SavedParams& params) const override {
    if (first_) return;
    params.number("temperature", heat_.value);
    params.number("target", heat_.limit);
  }

  void report(const View&, Reading& state) const override {
    state.set("temperature", heat_.value);
    state.set("target", heat_.limit);
    state.set("changes", changes_);
  }

 private:
  static double air(const View& view) { return air_temperature(view, view.pose().position); }

  std::vector<SurfaceRef> surfaces_;
  Approach heat_;          // K
  int unknown_air_ = 2;    // updates, until a climate has reported the air that it starts at
  bool targeted_ = false;  // given, too: its target; or commanded
  bool first_ = true;
  bool set_ = false;  // whether the world has its present target
  bool changes_ = false;
  Refresh due_{kRate};
};

ANGEN_REGISTER_DEVICE(WarmSurface,
                      Kind("warm_surface",
                           "A surface that warms and cools by command; PIRs see it.")
                          .model("warm_surface")
                          .example("set warm_surface panel1 temperature 320")
                          .verb("Temperature", "kelvin", "K", kKelvin, "sets its target")
                          .verb("Air", "sets its target to the temperature of the air around")
                          .number("temperature", "K", "of the surface, once a second")
                          .shown(1)
                          .number("target", "K", "that it approaches")
                          .flag("changes", "whether it is more than 1 mK from its target")
                          .shown_as("changes", "steady"))

}  // namespace angen::devices
