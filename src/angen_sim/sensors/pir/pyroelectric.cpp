#include "sensors/pir/pyroelectric.h"

#include <cmath>
#include <utility>

#include "core/text.h"
#include "plugin/view.h"
#include "sensors/fan.h"

namespace angen::sensors {

namespace {

constexpr Range kAngles{-M_PI, M_PI};
constexpr double kSamplesPerCutoff = 2.0;
constexpr double kMaxNoise = 9.0;       // standard deviations: Rng::gaussian() makes at most 8.6
constexpr int kLongestDecay = 1 << 12;  // samples that are computed ahead
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
  rays_.zones = lens.directions();
  const double facet =
      params.number("facet_area", 3e-5, "m^2", "of the lens, for one zone pair", kPositive);
  const double passes = params.number("transmission", 0.4, "",
                                      "of lens and window, of all heat radiation", {1e-6, 1.0});
  const double rate =
      params.number("sample_rate", 100.0, "Hz", "how often it samples", {20.0, 1000.0});
  state_.period = from_seconds(1.0 / rate);
  heat_ = Heat(std::move(lens), rays_.max, facet * passes, state_.period);
  const BandPass::Corners corners = read_corners(params);
  if (rate <= kSamplesPerCutoff * corners.high) {
    throw params.error("sample_rate", "<sample_rate> must be more than twice <high_cutoff>");
  }
  const double responsivity =
      params.number("responsivity", 3300.0, "V/W", "of the elements, at 1 Hz", kPositive);
  state_.signal.band = BandPass(corners, responsivity, to_seconds(state_.period));
  state_.noise = params.number("noise_stddev", 3e-6, "V", "while it is awake", kNotNegative);
  state_.threshold =
      params.number("signal_threshold", 3e-4, "V", "motion beyond plus or minus this", kPositive);
  state_.signal.rest = params.number("rest_threshold", 1e-6, "V",
                                     "a filter nearer than this to rest is at rest", kPositive);
  times_ = read_times(params, kTimes);
  false_alarm_rate_ = params.number("false_alarm_rate", 0.0, "1/h", "without any cause", {0, 3600});
}

void PirSignal::settle(double constant) {
  band.settle(constant);
  flux = constant;
  volts = 0.0;
  asleep = true;
}

void PirSignal::step(double next) {
  if (asleep && next == flux) return;
  volts = band.step(next);
  asleep = next == flux && band.settled(next, rest);
  flux = next;
  if (asleep) settle(next);
}

void Pyroelectric::Decay::advance(Nanoseconds to) {
  const std::int64_t count = (to - time + period / 2) / period;
  bool constant = false;
  for (std::int64_t i = 1; i <= count && !(constant && signal.asleep); ++i) {
    const Nanoseconds at = time + i * period;
    signal.step(constant ? signal.flux : filtered_flux(at));
    constant = constant || sources->constant(at);
  }
  time = to;
}

Nanoseconds Pyroelectric::Decay::quiet_until(double limit) const {
  Decay ahead = *this;
  for (int i = 0; i < kLongestDecay; ++i) {
    ahead.advance(ahead.time + period);
    if (std::abs(ahead.signal.volts) >= limit) break;
    if (ahead.signal.asleep && sources->constant(ahead.time)) return kForever;
  }
  return ahead.time;
}

double Pyroelectric::Decay::with_noise(Rng& rng) const {
  return signal.asleep ? 0.0 : signal.volts + noise * rng.gaussian();
}

void Pyroelectric::Decay::write(double signal_now, Reading& reading) const {
  reading.set("motion", motion);
  reading.set("signal", signal_now);
  reading.set("signal_threshold", threshold);
  reading.set("flux", sources->flux(time));
}

void Pyroelectric::Decay::read(Nanoseconds to, const Draws& draws, Reading& reading) const {
  Decay then = *this;
  then.advance(to);
  Rng rng = draws(0);
  then.write(then.with_noise(rng), reading);
}

void Pyroelectric::aim(const View& view, RayBatch&) {
  if (view.time() < state_.time) heat_.forget();  // the clock was set back
  heat_.sample(view);
}

void Pyroelectric::read(const View& view, Hits, Rng& rng, Reading& reading) {
  const double flux = heat_.flux(view.time()) - heat_.drift();
  const bool first = state_.time < 0 || view.time() < state_.time;
  if (first) {
    trigger_ = Trigger(times_, view.time());
    state_.signal.settle(flux);
  }
  const bool as_expected = first || flux == state_.filtered_flux(view.time());
  const bool has_same_sources = state_.sources == heat_.sources();
  state_.time = view.time();
  state_.sources = heat_.sources();
  state_.drift = heat_.drift();
  state_.signal.step(flux);
  const double signal = state_.with_noise(rng);
  const bool alarm = false_alarm(rng);
  const bool was_on = std::exchange(
      state_.motion, trigger_.step(view.time(), std::abs(signal) > state_.threshold || alarm));
  if (!as_expected) {
    quiet_until_ = view.time();
  } else if (!has_same_sources || quiet_until_ <= view.time()) {
    quiet_until_ = state_.quiet_until(state_.threshold - kMaxNoise * state_.noise);
  }
  if (quiet_until_ > view.time()) heat_.rest();
  state_.write(signal, reading);
  if (state_.motion == was_on) return;
  const std::string mover = state_.motion ? view.model_of(heat_.mover()) : "";
  const std::string by = mover.empty() ? "" : ", " + mover;
  const std::string detail = alarm ? "false alarm" : text_of("signal ", 1e6 * signal, " uV", by);
  reading.announce(state_.motion ? "motion" : "still", detail);
}

Nanoseconds Pyroelectric::idle_until(const Ahead&) const {
  if (heat_.pending() || false_alarm_rate_ > 0.0) return 0;
  return std::min(trigger_.off_at(), quiet_until_);
}

std::shared_ptr<const LazyReading> Pyroelectric::lazy_reading() const {
  if (state_.signal.asleep && !state_.motion) return nullptr;
  return std::make_shared<Decay>(state_);
}

bool Pyroelectric::false_alarm(Rng& rng) const {
  if (false_alarm_rate_ == 0.0) return false;
  return rng.uniform() < false_alarm_rate_ / 3600.0 * to_seconds(state_.period);
}

}  // namespace angen::sensors
