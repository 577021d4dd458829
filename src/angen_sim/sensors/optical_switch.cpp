// liboptical_switch_controller.so
#include <algorithm>
#include <cmath>

#include "plugin/registration.h"
#include "sensors/fan.h"

namespace angen::sensors {

namespace {

Fan default_fan() {
  Fan fan;
  fan.columns = 2;
  fan.min_yaw = -0.02;
  fan.max_yaw = 0.02;
  fan.max = 0.5;
  return fan;
}

/// The two rays, and their ranges while nothing changes.
struct Beam : LazyReading {
  Fan fan;
  double threshold = 0.0;  // m
  double length = 0.0;     // m, to the detector
  Ranges clean;            // ranges of the last sample, without noise

  bool closed_by(const Ranges& ranges) const {
    return *std::min_element(ranges.begin(), ranges.end()) < length - threshold;
  }

  void write(const Ranges& ranges, const Ranges& before, Reading& reading) const {
    const double difference = greatest_difference(ranges, before);
    reading.set("closed", closed_by(ranges));
    reading.set("changed", difference > threshold);
    reading.set("ranges", ranges);
    reading.set("difference", difference);
    reading.set("threshold", threshold);
  }

  void read(Nanoseconds, const Draws& draws, Reading& reading) const override {
    write(fan.with_noise(clean, draws(0)), fan.with_noise(clean, draws(1)), reading);
  }
};

}  // namespace

/// A light barrier of two rays, closed while one of them is blocked.
class OpticalSwitch : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    beam_.fan = read_fan(params, default_fan());
    if (beam_.fan.size() != 2) {
      throw params.error(
          "ray/scan/horizontal/samples",
          "an optical switch has " + std::to_string(beam_.fan.size()) + " rays, must have 2");
    }
    directions_ = beam_.fan.directions();
    beam_.threshold = params.number("threshold", 0.05, "m",
                                    "a range that differs by more is a change", kPositive);
    beam_.length = params.number("beam_length", beam_.fan.max, "m",
                                 "to the detector, when nothing is "
                                 "between; <ray><range><max> unless given",
                                 {0.0, beam_.fan.max});
    quiet_ = beam_.fan.quiet_within(beam_.threshold / 2.0, directions_.size());
    sample_period_ = read_sample_period(params);
  }

  std::optional<RayGeometry> rays() const override { return beam_.fan; }
  int ray_set(const View&) override { return 0; }
  void aim(const View& view, RayBatch& rays) override { beam_.fan.aim(view, directions_, rays); }

  void read(const View&, Hits hits, Rng& rng, Reading& reading) override {
    beam_.clean = beam_.fan.measure(hits);
    Ranges ranges = beam_.fan.with_noise(beam_.clean, rng);
    const bool first = previous_.empty();
    const bool closed = beam_.closed_by(ranges);
    const bool flipped = !first && closed != closed_;
    const double difference = greatest_difference(ranges, previous_);
    const bool changed = difference > beam_.threshold;
    beam_.write(ranges, previous_, reading);
    reading.urgent = changed || flipped;
    if (flipped) reading.event = closed ? "closed" : "opened";
    closed_ = closed;
    previous_ = std::move(ranges);
    if (!beam_.fan.noisy()) {
      steady_ = !first && difference == 0.0 && !flipped;
    } else {
      steady_ = quiet_.has(rng) && !changed && !flipped && decided();
    }
  }

  Nanoseconds idle_until(const Ahead& ahead) const override {
    if (!steady_) return 0;
    return beam_.fan.noisy() ? quiet_.until(ahead, 1) : kForever;
  }
  std::shared_ptr<const LazyReading> lazy_reading() const override {
    if (!beam_.fan.noisy()) return nullptr;
    return std::make_shared<Beam>(beam_);
  }
  void skip(Nanoseconds, const Draws& draws) override {
    previous_ = beam_.fan.with_noise(beam_.clean, draws(0));
  }

 private:
  /// Whether quiet noise cannot turn closed to open or back.
  bool decided() const {
    double nearest = beam_.fan.max;
    for (const double range : beam_.clean) {
      if (range < beam_.fan.max) nearest = std::min(nearest, range + beam_.fan.noise_mean);
    }
    return std::abs(nearest - (beam_.length - beam_.threshold)) > beam_.threshold / 2.0;
  }

  Beam beam_;
  std::vector<Vec3> directions_;
  QuietNoise quiet_;
  Ranges previous_;
  bool closed_ = false;
  bool steady_ = false;
};

ANGEN_REGISTER_SENSOR(OpticalSwitch,
                      Kind("switch", "A light barrier of two rays at a door.")
                          .rate(1.0)
                          .model("optical_switch")
                          .example("spawn switch s1 --pose \"2.1 3.94 2.125\"")
                          .ray_color("0 0 1 1")
                          .flag("closed", "a ray is blocked")
                          .alarm("closed", "open")
                          .events("closed", "opened")
                          .flag("changed",
                                "a range differs from the last sample's by more than "
                                "the threshold")
                          .numbers("ranges", "m", "of both rays")
                          .shown(3)
                          .number("difference", "m", "greatest, from the last sample's ranges")
                          .number("threshold", "m", "as its parameter"))

}  // namespace angen::sensors
