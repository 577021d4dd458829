// libdoorbell.so
#include <limits>
#include <utility>
#include <vector>

#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/view.h"

namespace angen::devices {

namespace {

constexpr double kMute = -std::numeric_limits<double>::infinity();  // dB

}  // namespace

/// A doorbell: its button lets a chime sound for a while, which microphones hear.
class Doorbell : public Device {
 public:
  void configure(Params& params, Wiring&) override {
    duration_ =
        from_seconds(params.number("duration", 2.0, "s", "for which a ring sounds", kPositive));
    sound_ =
        params.number("sound_power_level", 85.0, "dB", "of the chime, over 1 pW", {-100.0, 200.0});
    directivity_ =
        params.number("directivity", 2.0, "",
                      "of its sound: 1 in free air, 2 on a wall, 4 in an edge", {0.1, 1000.0});
    const auto places =
        params.rows("position", 3, "m", "x y z in the model's frame where it sounds; 0 0 0");
    if (places.size() > 1) throw params.error("position", "a doorbell has one <position>");
    if (!places.empty()) position_ = places.front();
    left_ = from_seconds(
        params.number("remaining", 0.0, "s", "of a ring that sounds at the start", kNotNegative));
  }

  Verdict command(const Command&, const View&) override {
    return Verdict::accept([this] { pressed_ = true; });
  }

  // A button that is pressed again lets the chime begin again.
  void update(const View& view, Outputs& outputs) override {
    const Nanoseconds passed = started_ ? view.time() - now_ : 0;
    started_ = true;
    now_ = view.time();
    left_ = passed < left_ ? left_ - passed : 0;
    if (!std::exchange(pressed_, false)) return;
    left_ = duration_;
    ++rings_;
    outputs.event("rang", "");
  }

  Nanoseconds idle_until(const View&) const override { return left_ > 0 ? 0 : kForever; }

  void save(SavedParams& params) const override { params.number("remaining", to_seconds(left_)); }

  void report(const View&, Reading& state) const override {
    state.set("ringing", left_ > 0);
    state.set("rings", rings_);
    state.set("sound_power_level", left_ > 0 ? sound_ : kMute);
    state.set("directivity", directivity_);
    state.set("position", position_);
  }

 private:
  Nanoseconds duration_ = 0;
  double sound_ = 0.0;  // dB over 1 pW
  double directivity_ = 1.0;
  std::vector<double> position_{0.0, 0.0, 0.0};
  bool pressed_ = false;
  bool started_ = false;
  Nanoseconds now_ = 0;   // time of the last update
  Nanoseconds left_ = 0;  // rest of the ring, at `now_`
  std::int64_t rings_ = 0;
};

ANGEN_REGISTER_DEVICE(Doorbell,
                      Kind("doorbell", "A doorbell, which microphones hear.")
                          .model("doorbell")
                          .example("set doorbell hall0 ring")
                          .verb("Ring", "as its button does")
                          .flag("ringing", "whether it sounds")
                          .alarm("RINGS", "")
                          .integer("rings", "", "since the start")
                          .number("sound_power_level", "dB",
                                  "over 1 pW; minus infinity where it is silent")
                          .number("directivity", "", "of its sound")
                          .numbers("position", "m", "x y z in the model's frame where it sounds"))

}  // namespace angen::devices
