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

struct RangeDifference::Scans : LazyReading {
  Fan fan;
  Nod nod;
  double threshold = 0.0;
  std::vector<Ranges> clean;  // by phase

  void read(Nanoseconds time, const Draws& draws, Reading& reading) const override {
    const Ranges& scan = clean[nod.phase(time)];
    Ranges now = fan.with_noise(scan, draws(0));
    const Ranges before = fan.with_noise(scan, draws(static_cast<int>(nod.phases)));
    const double difference = greatest_difference(now, before);
    write(std::move(now), difference, threshold, reading);
  }
};

void RangeDifference::configure(Params& params, Wiring&) {
  fan_ = read_fan(params, default_fan());
  threshold_ =
      params.number("threshold", 0.1, "m", "a range that differs by more is motion", kPositive);
  // Two scans that are both within half the threshold do not differ by more than it.
  quiet_chance_ = fan_.quiet_chance(threshold_ / 2.0);
  const double amplitude =
      params.number("nod_amplitude", 0.0, "rad", "nods so far up and down", {0.0, M_PI_2});
  const double nod_period = params.number("nod_period", 0.0, "s", "of a whole nod", kNotNegative);
  nod_.period = params.update_period();
  nod_.phases = amplitude > 0.0 ? count_phases(params, nod_period) : 1;
  for (std::size_t k = 0; k < nod_.phases; ++k) {
    const double turn = 2.0 * M_PI * static_cast<double>(k) / static_cast<double>(nod_.phases);
    directions_.push_back(fan_.directions(amplitude * std::sin(turn)));
  }
  previous_.resize(nod_.phases);
  if (fan_.noisy()) clean_.resize(nod_.phases);
}

int RangeDifference::ray_set(const View& view) {
  const bool first = last_time_ < 0 || view.time() < last_time_;  // or the clock was set back
  if (first) {
    nod_.first_time = view.time();
    std::fill(previous_.begin(), previous_.end(), Ranges{});
  }
  last_time_ = view.time();
  phase_ = nod_.phase(view.time());
  return static_cast<int>(phase_);
}

void RangeDifference::aim(const View& view, RayBatch& rays) {
  fan_.aim(view.pose(), directions_[phase_], rays);
}

void RangeDifference::write(Ranges ranges, double difference, double threshold, Reading& reading) {
  reading.set("ranges", std::move(ranges));  // for drawing the rays
  reading.set("motion", difference > threshold);
  reading.set("difference", difference);
  reading.set("threshold", threshold);
  reading.set("signal", difference);
  reading.set("signal_threshold", threshold);
}

void RangeDifference::read(const View&, Hits hits, Rng& rng, Reading& reading) {
  Ranges ranges = fan_.measure(hits);
  if (fan_.noisy()) clean_[phase_] = ranges;
  ranges = fan_.with_noise(std::move(ranges), rng);
  const double difference = greatest_difference(ranges, previous_[phase_]);
  previous_[phase_] = ranges;
  write(std::move(ranges), difference, threshold_, reading);
  const bool motion = difference > threshold_;
  if (motion != motion_) {
    reading.event = motion ? "motion" : "still";
    std::ostringstream detail;
    detail << "difference " << difference << " m";
    reading.event_detail = detail.str();
  }
  motion_ = motion;
  changes_ = difference > 0.0;
  const bool loud = rng.uniform() >= quiet_chance_;  // with_noise() drew from a copy
  quiet_scans_ = loud || motion ? 0 : quiet_scans_ + 1;
}

bool RangeDifference::steady() const {
  return varies() ? quiet_scans_ >= previous_.size() : !changes_;
}

std::shared_ptr<const LazyReading> RangeDifference::lazy_reading() const {
  auto scans = std::make_shared<Scans>();
  scans->fan = fan_;
  scans->nod = nod_;
  scans->threshold = threshold_;
  scans->clean = fan_.noisy() ? clean_ : previous_;
  return scans;
}

void RangeDifference::resume(Nanoseconds time, const Draws& draws) {
  if (!fan_.noisy()) return;
  for (std::size_t ago = 0; ago < nod_.phases; ++ago) {
    const std::size_t phase = (nod_.phase(time) + nod_.phases - ago) % nod_.phases;
    previous_[phase] = fan_.with_noise(clean_[phase], draws(static_cast<int>(ago)));
  }
}

std::size_t RangeDifference::count_phases(const Params& params, double nod_period) const {
  const double scans = nod_period / to_seconds(nod_.period);
  const double whole = std::round(scans);
  if (whole < 1.0 || std::abs(scans - whole) > 1e-6 * whole) {
    std::ostringstream message;
    message << "<nod_period> is " << nod_period << " s, must be a multiple of "
            << to_seconds(nod_.period) << " s, the time between two scans";
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
