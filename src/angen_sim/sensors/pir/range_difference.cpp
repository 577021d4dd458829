#include "sensors/pir/range_difference.h"

#include <algorithm>
#include <cmath>
#include <sstream>

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

void RangeDifference::configure(Params& params, Wiring&) {
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

int RangeDifference::stance(const View& view) {
  const bool first = last_time_ < 0 || view.time() < last_time_;  // or the clock was set back
  if (first) {
    first_time_ = view.time();
    std::fill(previous_.begin(), previous_.end(), Ranges{});
  }
  last_time_ = view.time();
  const Nanoseconds scans = (view.time() - first_time_ + period_ / 2) / period_;
  phase_ = static_cast<std::size_t>(scans) % previous_.size();
  return static_cast<int>(phase_);
}

void RangeDifference::aim(const View& view, RayBatch& rays) {
  fan_.aim(view.pose(), directions_[phase_], rays);
}

void RangeDifference::read(const View&, Hits hits, Rng& rng, Reading& reading) {
  const bool loud = !quiet(rng);
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
  changes_ = difference > 0.0;
  quiet_scans_ = loud || motion ? 0 : quiet_scans_ + 1;
}

Rest RangeDifference::rest() const {
  if (previous_.size() == 1 && !fan_.noisy()) return changes_ ? Rest::kBusy : Rest::kSame;
  return quiet_scans_ >= previous_.size() ? Rest::kNoise : Rest::kBusy;
}

std::size_t RangeDifference::count_phases(const Params& params, double nod_period) const {
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

}  // namespace angen::sensors
