#include <algorithm>
#include <cmath>
#include <sstream>

#include "plugin/register.h"
#include "sensors/fan.h"

namespace angen::sensors {

namespace {

constexpr std::size_t kMostDirections = 1'000'000;

Fan default_fan() {
  Fan fan;
  fan.columns = 16;
  fan.min_yaw = -0.7854;
  fan.max_yaw = 0.7854;
  fan.min = 0.05;
  fan.max = 6.0;
  return fan;
}

}  // namespace

/// A motion detector that compares successive range scans. One that nods compares each scan with
/// the one that it took at the same height a nod ago.
class Pir : public Sensor {
 public:
  void configure(Params& params, Wiring&) override {
    params.choice("model", "range_difference", {"range_difference"}, "how motion is found");
    fan_ = read_fan(params, default_fan());
    threshold_ =
        params.number("threshold", 0.1, "m", "a range that differs by more is motion", kPositive);
    const double amplitude =
        params.number("nod_amplitude", 0.0, "rad", "nods so far up and down", {0.0, M_PI_2});
    const double nod_period = params.number("nod_period", 0.0, "s", "of a whole nod", kNotNegative);
    period_ = params.update_period(default_rate());
    const std::size_t phases = amplitude > 0.0 ? count_phases(params, nod_period) : 1;
    for (std::size_t k = 0; k < phases; ++k) {
      const double turn = 2.0 * M_PI * static_cast<double>(k) / static_cast<double>(phases);
      directions_.push_back(fan_.directions(amplitude * std::sin(turn)));
    }
    previous_.resize(phases);
  }

  void aim(const View& view, RayBatch& rays) override {
    const bool first = last_time_ < 0 || view.time() < last_time_;  // or the clock was set back
    if (first) {
      first_time_ = view.time();
      std::fill(previous_.begin(), previous_.end(), Ranges{});
    }
    last_time_ = view.time();
    const Nanoseconds scans = (view.time() - first_time_ + period_ / 2) / period_;
    phase_ = static_cast<std::size_t>(scans) % previous_.size();
    fan_.aim(view.pose(), directions_[phase_], rays);
  }

  void read(const View&, Hits hits, Rng& rng, Reading& reading) override {
    Ranges ranges = fan_.measure(hits, rng);
    const double difference = greatest_difference(ranges, previous_[phase_]);
    reading.set("ranges", ranges);  // for those who draw the rays
    previous_[phase_] = std::move(ranges);
    const bool motion = difference > threshold_;
    reading.set("motion", motion);
    reading.set("difference", difference);
    reading.set("threshold", threshold_);
    reading.set("signal", difference);
    reading.set("signal_threshold", threshold_);
    if (motion != motion_) {
      reading.event = motion ? "motion" : "still";
      std::ostringstream detail;
      detail << "difference " << difference << " m";
      reading.event_detail = detail.str();
    }
    motion_ = motion;
  }

 private:
  std::size_t count_phases(const Params& params, double nod_period) const {
    const double scans = nod_period / to_seconds(period_);
    const double whole = std::round(scans);
    if (whole < 1.0 || std::abs(scans - whole) > 1e-6 * whole) {
      std::ostringstream message;
      message << "<nod_period> is " << nod_period << " s, must be a multiple of "
              << to_seconds(period_) << " s, the time between two scans";
      throw params.error("nod_period", message.str());
    }
    if (whole * static_cast<double>(fan_.size()) > kMostDirections) {
      throw params.error("nod_period",
                         "a nod has more than a million rays; take a shorter "
                         "<nod_period> or fewer samples");
    }
    return static_cast<std::size_t>(whole);
  }

  Fan fan_;
  double threshold_ = 0.0;
  Nanoseconds period_ = kSecond;
  std::vector<std::vector<Vec3>> directions_;  // by phase of the nod
  std::vector<Ranges> previous_;               // by phase; empty before its first scan
  Nanoseconds first_time_ = 0;
  Nanoseconds last_time_ = -1;
  std::size_t phase_ = 0;
  bool motion_ = false;
};

ANGEN_REGISTER_SENSOR(Pir, "pir", "A motion detector that compares successive range scans.")

}  // namespace angen::sensors
