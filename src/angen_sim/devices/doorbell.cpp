// libdoorbell.so
#include <utility>

#include "devices/sound.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/view.h"

namespace angen::devices {

/// A doorbell: its button lets a chime sound for a while, which microphones hear.
class Doorbell : public Device {
 public:
  void configure(Params& params, Wiring&) override {
    duration_ =
        from_seconds(params.number("duration", 2.0, "s", "for which a ring sounds", kPositive));
    sound_.configure(params, 85.0, "of the chime, over 1 pW");
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
    sound_.report(left_ > 0 ? sound_.level() : Sound::kSilent, state);
  }

 private:
  Nanoseconds duration_ = 0;
  Sound sound_;
  bool pressed_ = false;
  bool started_ = false;
  Nanoseconds now_ = 0;   // time of the last update
  Nanoseconds left_ = 0;  // rest of the ring, at `now_`
  std::int64_t rings_ = 0;
};

ANGEN_REGISTER_DEVICE(Doorbell,
                      Sound::describe(Kind("doorbell", "A doorbell, which microphones hear.")
                                          .model("doorbell")
                                          .example("set doorbell hall0 ring")
                                          .verb("Ring", "as its button does")
                                          .flag("ringing", "whether it sounds")
                                          .alarm("RINGS", "")
                                          .integer("rings", "", "since the start")))

}  // namespace angen::devices
