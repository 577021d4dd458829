// libpressure_mat.so
#include <algorithm>

#include "core/text.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "sensors/debounce.h"
#include "sensors/watched.h"

namespace angen::sensors {

namespace {

constexpr double kStandardGravity = 9.80665;  // m/s^2, by which scales are marked

}  // namespace

/// A mat that closes its contact under a load, the force along its own -z.
class PressureMat : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override {
    threshold_ = params.number("threshold", 10.0, "kg", "it fires above this load", kPositive);
    release_ = params.number("release", 0.8 * threshold_, "kg",
                             "and is free below this one; 0.8 of the threshold unless given",
                             {0.0, threshold_});
    sample_period_ = read_sample_period(params);
    debounce_.duration = from_seconds(
        params.number("debounce", 0.05, "s", "least duration of a load that counts", kNotNegative));
    noise_stddev_ = params.number("noise_stddev", 0.0, "kg", "of a load", kNotNegative);
    collisions_ = read_watched(params, wiring, "a pressure mat");
  }

  void read(const View& view, Hits, Rng& rng, Reading& reading) override {
    const double load = load_on(view) + (noise_stddev_ > 0.0 ? noise_stddev_ * rng.gaussian() : 0);
    const bool loaded = pressed_ ? load > release_ : load > threshold_;
    if (debounce_.changes(pressed_, loaded, view.time())) {
      pressed_ = loaded;
      reading.announce(pressed_ ? "pressed" : "released", text_of("load ", load, " kg"));
    }
    reading.set("pressed", pressed_);
    reading.set("load", load);
    reading.set("threshold", threshold_);
  }

  /// 0 while noise may press it, or it waits for the end of a debounce.
  Nanoseconds idle_until(const Ahead&) const override {
    return noise_stddev_ == 0.0 && !debounce_.waits() ? kForever : 0;
  }

 private:
  // kg; a force upwards is not a load.
  double load_on(const View& view) const {
    const Vec3 down = view.pose().rotation * -Vec3::UnitZ();
    double force = 0.0;
    for (const ContactRef collision : collisions_) {
      for (const ContactPair& pair : view.contacts(collision)) {
        for (const ContactPoint& point : pair.points) force += point.force.dot(down);
      }
    }
    return std::max(0.0, force) / kStandardGravity;
  }

  std::vector<ContactRef> collisions_;
  double threshold_ = 0.0;     // kg
  double release_ = 0.0;       // kg
  double noise_stddev_ = 0.0;  // kg
  Debounce debounce_;
  bool pressed_ = false;
};

ANGEN_REGISTER_SENSOR(PressureMat,
                      Kind("pressure", "A mat that fires under a load.")
                          .rate(1.0)
                          .model("pressure_mat")
                          .example("spawn pressure m1 --pose \"1 2 0\" --set threshold=20")
                          .flag("pressed", "whether the load is above the threshold")
                          .alarm("PRESSED", "free")
                          .events("pressed", "released")
                          .number("load", "kg", "on it, as a scale shows it")
                          .shown(1)
                          .number("threshold", "kg", "as its parameter"))

}  // namespace angen::sensors
