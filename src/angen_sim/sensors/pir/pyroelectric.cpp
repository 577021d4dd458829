#include "sensors/pir/pyroelectric.h"

#include <cmath>
#include <sstream>

#include "sensors/fan.h"

namespace angen::sensors {

namespace {

constexpr Range kAngles{-M_PI, M_PI};
constexpr double kSamplesPerCutoff = 2.0;
constexpr Trigger::Times kTimes{kSecond * 5 / 4, kSecond * 5 / 2, 60 * kSecond, true};

Window window_of(const std::vector<double>& row, std::size_t first, const char* key,
                 const Params& params) {
  const Window window{row[first], row[first + 1], row[first + 2], row[first + 3]};
  const bool fits = window.right >= kAngles.min && window.left <= kAngles.max &&
                    window.low >= -M_PI_2 && window.high <= M_PI_2;
  if (window.right < window.left && window.low < window.high && fits) return window;
  throw params.error(key, std::string("<") + key +
                              "> must end with azimuth from, to (-pi to pi), elevation from, to "
                              "(-pi/2 to pi/2), each rising, in rad");
}

FresnelLens read_camera(Params& params) {
  std::vector<FresnelLens::Row> rows = lens_rows(params.choice(
      "lens", "area", lens_names(), "where its zones are; long_range and curtain for walls"));
  const auto own = params.rows("zone_row", 5, "1 rad rad rad rad",
                               "instead of a lens: pairs of zones, azimuth from, to (left is "
                               "positive), elevation from, to");
  if (!own.empty()) rows.clear();
  for (const std::vector<double>& row : own) {
    const double pairs = row[0];
    if (pairs < 1.0 || pairs > 1000.0 || pairs != std::round(pairs)) {
      throw params.error("zone_row", "<zone_row> must begin with a whole number of zone pairs");
    }
    rows.push_back({static_cast<int>(pairs), window_of(row, 1, "zone_row", params)});
  }
  FresnelLens lens(rows);
  for (const std::vector<double>& row :
       params.rows("tape", 4, "rad rad rad rad",
                   "covers zones with their middle in azimuth from, to, elevation from, to")) {
    lens.tape(window_of(row, 0, "tape", params));
  }
  return lens;
}

/// Rays that show the zones in rviz: unless <scan> is given, a row across them.
RayGeometry rays_across(const Window& window) {
  RayGeometry rays;
  rays.columns = 13;
  rays.min_yaw = window.right;
  rays.max_yaw = window.left;
  rays.min_pitch = rays.max_pitch = 0.5 * (window.low + window.high);
  rays.max = 20.0;
  return rays;
}

BandPass::Corners read_corners(Params& params) {
  BandPass::Corners corners;
  corners.thermal_time = params.number("thermal_time_constant", corners.thermal_time, "s",
                                       "of the elements' warming", {1e-3, 1e3});
  corners.electrical_time = params.number("electrical_time_constant", corners.electrical_time, "s",
                                          "of their discharge", {1e-3, 1e3});
  corners.low = params.number("low_cutoff", corners.low, "Hz", "of the amplifier", {1e-3, 20.0});
  corners.high = params.number("high_cutoff", corners.high, "Hz", "of the amplifier", {0.1, 20.0});
  return corners;
}

}  // namespace

void Pyroelectric::configure(Params& params, Wiring&) {
  FresnelLens lens = read_camera(params);
  rays_ = read_rays(params, rays_across(lens.window()));
  const double facet =
      params.number("facet_area", 3e-5, "m^2", "of the lens, for one zone pair", kPositive);
  const double passes = params.number("transmission", 0.4, "",
                                      "of lens and window, of all heat radiation", {1e-6, 1.0});
  const double rate =
      params.number("sample_rate", 100.0, "Hz", "how often it samples", {20.0, 1000.0});
  period_ = from_seconds(1.0 / rate);
  heat_ = Heat(std::move(lens), rays_.max, facet * passes, period_);
  const BandPass::Corners corners = read_corners(params);
  if (rate <= kSamplesPerCutoff * corners.high) {
    throw params.error("sample_rate", "<sample_rate> must be more than twice <high_cutoff>");
  }
  const double responsivity =
      params.number("responsivity", 3300.0, "V/W", "of the elements, at 1 Hz", kPositive);
  band_ = BandPass(corners, responsivity, to_seconds(period_));
  noise_ = params.number("noise_stddev", 3e-6, "V", "while it is awake", kNotNegative);
  threshold_ =
      params.number("signal_threshold", 3e-4, "V", "motion beyond plus or minus this", kPositive);
  rest_ = params.number("rest_threshold", 1e-6, "V", "a filter nearer than this to rest is at rest",
                        kPositive);
  times_ = read_times(params, kTimes);
  false_alarm_rate_ = params.number("false_alarm_rate", 0.0, "1/h", "without any cause", {0, 3600});
}

void Pyroelectric::aim(const View& view, RayBatch& rays) {
  if (view.time() < last_time_) heat_.forget();  // the clock was set back
  heat_.aim(view, rays);
}

void Pyroelectric::read(const View& view, Hits hits, Rng& rng, Reading& reading) {
  const double flux = heat_.flux(hits);
  if (last_time_ < 0 || view.time() < last_time_) {
    trigger_ = Trigger(times_, view.time());
    band_.settle(flux - heat_.drift());
    asleep_ = true;
    flux_ = flux - heat_.drift();
  }
  last_time_ = view.time();
  const double signal = filter(flux - heat_.drift(), rng);
  const bool was_on = trigger_.on();
  const bool alarm = false_alarm(rng);
  const bool motion = trigger_.step(view.time(), std::abs(signal) > threshold_ || alarm);
  reading.set("motion", motion);
  reading.set("signal", signal);
  reading.set("signal_threshold", threshold_);
  reading.set("flux", flux);
  if (motion == was_on) return;
  reading.urgent = true;
  reading.event = motion ? "motion" : "still";
  std::ostringstream detail;
  if (alarm) {
    detail << "false alarm";
  } else {
    detail << "signal " << 1e6 * signal << " uV";
  }
  reading.event_detail = detail.str();
}

bool Pyroelectric::steady() const {
  return asleep_ && !heat_.pending() && !trigger_.on() && false_alarm_rate_ == 0.0;
}

// Volts for this sample. A constant flux lets the filter come to rest.
double Pyroelectric::filter(double flux, Rng& rng) {
  if (asleep_ && flux == flux_) return 0.0;
  const double signal = band_.step(flux);
  asleep_ = flux == flux_ && band_.settled(flux, rest_);
  flux_ = flux;
  if (!asleep_) return signal + noise_ * rng.gaussian();
  band_.settle(flux);
  return 0.0;
}

bool Pyroelectric::false_alarm(Rng& rng) const {
  if (false_alarm_rate_ == 0.0) return false;
  return rng.uniform() < false_alarm_rate_ / 3600.0 * to_seconds(period_);
}

}  // namespace angen::sensors
