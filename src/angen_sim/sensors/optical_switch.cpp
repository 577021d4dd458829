#include <algorithm>
#include <cmath>

#include "plugin/register.h"
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

}  // namespace

/// A light barrier of two rays, closed while something stands in one of them.
class OpticalSwitch : public Sensor {
 public:
  double default_rate() const override { return 1.0; }
  Nanoseconds sample_period() const override { return sample_period_; }

  void configure(Params& params, Wiring&) override {
    fan_ = read_fan(params, default_fan());
    if (fan_.size() != 2) {
      throw params.error(
          "ray/scan/horizontal/samples",
          "an optical switch has " + std::to_string(fan_.size()) + " rays, must have 2");
    }
    directions_ = fan_.directions();
    threshold_ = params.number("threshold", 0.05, "m", "a range that differs by more is a change",
                               kPositive);
    beam_length_ = params.number("beam_length", fan_.max, "m",
                                 "to the detector, when nothing is "
                                 "between; <ray><range><max> unless given",
                                 {0.0, fan_.max});
    const double sample_rate =
        params.number("sample_rate", 100.0, "Hz", "how often it looks", {1e-3, 1e6});
    sample_period_ = from_seconds(1.0 / sample_rate);
  }

  int stance(const View&) override { return 0; }
  void aim(const View& view, RayBatch& rays) override { fan_.aim(view.pose(), directions_, rays); }

  void read(const View&, Hits hits, Rng& rng, Reading& reading) override {
    const bool loud = !quiet(rng);
    Ranges ranges = fan_.measure(hits, rng);
    const bool first = previous_.empty();
    const double difference = greatest_difference(ranges, previous_);
    const bool changed = difference > threshold_;
    const double nearest = *std::min_element(ranges.begin(), ranges.end());
    const bool closed = nearest < beam_length_ - threshold_;
    const bool flipped = !first && closed != closed_;
    reading.set("closed", closed);
    reading.set("changed", changed);
    reading.set("ranges", ranges);
    reading.set("difference", difference);
    reading.set("threshold", threshold_);
    reading.urgent = changed || flipped;
    if (flipped) reading.event = closed ? "closed" : "opened";
    closed_ = closed;
    previous_ = std::move(ranges);
    if (!fan_.noisy()) {
      rest_ = first || difference > 0.0 || flipped ? Rest::kBusy : Rest::kSame;
    } else {
      rest_ = loud || changed || flipped || !decided(hits) ? Rest::kBusy : Rest::kNoise;
    }
  }

  Rest rest() const override { return rest_; }
  bool quiet(Rng rng) const override { return fan_.quiet(rng, threshold_ / 2.0); }
  int memory() const override { return 1; }

 private:
  /// Whether quiet noise cannot turn closed to open or back.
  bool decided(Hits hits) const {
    double nearest = fan_.max;
    for (const rays::Hit& hit : hits) {
      if (hit.range < fan_.max) nearest = std::min(nearest, hit.range + fan_.noise_mean);
    }
    return std::abs(nearest - (beam_length_ - threshold_)) > threshold_ / 2.0;
  }

  Fan fan_;
  std::vector<Vec3> directions_;
  double threshold_ = 0.0;
  double beam_length_ = 0.0;
  Nanoseconds sample_period_ = kSecond / 100;
  Ranges previous_;
  bool closed_ = false;
  Rest rest_ = Rest::kBusy;
};

ANGEN_REGISTER_SENSOR(OpticalSwitch, "switch", "A light barrier of two rays at a door.")

}  // namespace angen::sensors
