#include "sensors/pir/range_difference.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "plugin/view.h"

namespace angen::sensors {

namespace {

constexpr std::size_t kMaxDirections = 1'000'000;

Fan pir_fan() {
  Fan fan;
  fan.columns = 16;
  fan.min_yaw = -0.7854;
  fan.max_yaw = 0.7854;
  fan.min = 0.05;
  fan.max = 6.0;
  return fan;
}

/// Whether a range has grown by more than `threshold`: an obstacle has left.
bool any_longer(const Ranges& now, const Ranges& before, double threshold) {
  for (std::size_t i = 0; i < std::min(now.size(), before.size()); ++i) {
    if (now[i] - before[i] > threshold) return true;
  }
  return false;
}

void announce_range(bool motion, double difference, Reading& reading) {
  reading.event = motion ? "motion" : "still";
  reading.event_detail = text_of("difference ", difference, " m");
}

}  // namespace

struct RangeDifference::Scans : LazyReading {
  Fan fan;
  Nod nod;
  double threshold = 0.0;
  std::vector<Ranges> clean;  // by phase

  void read(Nanoseconds time, const Draws& draws, Reading& reading) const override {
    const std::size_t phase = nod.phase(time);
    const Ranges& last = clean[(phase + nod.phases - 1) % nod.phases];
    Ranges now = scan_of(fan, clean[phase], draws(0)).ranges;
    const double difference = greatest_difference(now, scan_of(fan, last, draws(1)).ahead);
    write(std::move(now), difference, threshold, reading);
    reading.set("motion", false);
    reading.set("departure", false);
  }
};

void RangeDifference::configure(Params& params, Wiring&) {
  fan_ = read_fan(params, pir_fan());
  threshold_ =
      params.number("threshold", 0.1, "m", "a range that differs by more is motion", kPositive);
  const double amplitude = params.number("nod_amplitude", 0.0, "rad",
                                         "amplitude of the nodding, up and down", {0.0, M_PI_2});
  const double nod_period = params.number("nod_period", 0.0, "s", "of a whole nod", kNotNegative);
  nod_.period = params.update_period();
  nod_.phases = amplitude > 0.0 ? count_phases(params, nod_period) : 1;
  times_ = read_times(params, {});
  for (std::size_t k = 0; k < nod_.phases; ++k) {
    const double turn = 2.0 * M_PI * static_cast<double>(k) / static_cast<double>(nod_.phases);
    fan_.tilts.push_back(amplitude * std::sin(turn));
  }
  for (std::size_t k = 0; k < nod_.phases; ++k) {
    directions_.push_back(fan_.directions(fan_.tilts[k]));
    if (nod_.phases == 1) break;
    const std::vector<Vec3> next = fan_.directions(fan_.tilts[(k + 1) % nod_.phases]);
    directions_.back().insert(directions_.back().end(), next.begin(), next.end());
  }
  quiet_ = fan_.quiet_within(threshold_ / 2.0, directions_[0].size());
  previous_.resize(nod_.phases);
  clean_.resize(nod_.phases);
}

int RangeDifference::ray_set(const View& view) {
  const bool first = last_time_ < 0 || view.time() < last_time_;  // or the clock was set back
  if (first) {
    nod_.first_time = view.time();
    std::fill(previous_.begin(), previous_.end(), Ranges{});
    ahead_.clear();
    trigger_ = Trigger(times_, view.time());
  }
  last_time_ = view.time();
  phase_ = nod_.phase(view.time());
  return static_cast<int>(phase_);
}

void RangeDifference::aim(const View& view, RayBatch& rays) {
  fan_.aim(view, directions_[phase_], rays);
}

RangeDifference::Scan RangeDifference::scan_of(const Fan& fan, const Ranges& clean,
                                               const Rng& rng) {
  const auto rays = static_cast<std::ptrdiff_t>(fan.size());
  Scan scan;
  scan.ranges = fan.with_noise(clean, rng);
  scan.ahead = Ranges(scan.ranges.end() - rays, scan.ranges.end());
  scan.ranges.resize(fan.size());
  return scan;
}

void RangeDifference::write(Ranges ranges, double difference, double threshold, Reading& reading) {
  reading.set("ranges", std::move(ranges));  // for drawing the rays
  reading.set("difference", difference);
  reading.set("threshold", threshold);
  reading.set("signal", difference);
  reading.set("signal_threshold", threshold);
}

void RangeDifference::read(const View& view, Hits hits, Rng& rng, Reading& reading) {
  clean_[phase_] = fan_.measure(hits);
  Scan scan = scan_of(fan_, clean_[phase_], rng);
  const double difference = greatest_difference(scan.ranges, ahead_);
  const bool was_on = trigger_.on();
  const bool motion = trigger_.step(view.time(), difference > threshold_);
  const bool departure =
      !motion && nod_.phases > 1 && any_longer(scan.ranges, previous_[phase_], threshold_);
  previous_[phase_] = scan.ranges;
  ahead_ = std::move(scan.ahead);
  write(std::move(scan.ranges), difference, threshold_, reading);
  reading.set("motion", motion);
  reading.set("departure", departure);
  if (motion != was_on) announce_range(motion, difference, reading);
  changes_ = difference > 0.0 || motion;
  const bool quiet = quiet_.has(rng) && !motion && !departure && difference <= threshold_;
  quiet_scans_ = quiet ? quiet_scans_ + 1 : 0;
}

Nanoseconds RangeDifference::idle_until(const Ahead& ahead) const {
  if (!varies()) return changes_ ? 0 : kForever;
  if (quiet_scans_ < nod_.phases) return 0;
  return quiet_.until(ahead, static_cast<int>(nod_.phases));
}

std::shared_ptr<const LazyReading> RangeDifference::lazy_reading() const {
  if (!varies()) return nullptr;
  auto scans = std::make_shared<Scans>();
  scans->fan = fan_;
  scans->nod = nod_;
  scans->threshold = threshold_;
  scans->clean = clean_;
  return scans;
}

void RangeDifference::skip(Nanoseconds time, const Draws& draws) {
  for (std::size_t ago = nod_.phases; ago-- > 0;) {
    const std::size_t phase = (nod_.phase(time) + nod_.phases - ago) % nod_.phases;
    Scan scan = scan_of(fan_, clean_[phase], draws(static_cast<int>(ago)));
    previous_[phase] = std::move(scan.ranges);
    ahead_ = std::move(scan.ahead);  // at last that of `time`
  }
}

std::size_t RangeDifference::count_phases(const Params& params, double nod_period) const {
  const double scans = nod_period / to_seconds(nod_.period);
  const double whole = std::round(scans);
  if (whole < 1.0 || std::abs(scans - whole) > 1e-6 * whole) {
    throw params.error("nod_period",
                       text_of("<nod_period> is ", nod_period, " s, must be a multiple of ",
                               to_seconds(nod_.period), " s, the time between two scans"));
  }
  if (whole * static_cast<double>(fan_.size()) > kMaxDirections) {
    throw params.error("nod_period",
                       "a nod has more than a million rays; take a shorter "
                       "<nod_period> or fewer samples");
  }
  return static_cast<std::size_t>(whole);
}

}  // namespace angen::sensors
