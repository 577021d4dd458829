#pragma once

#include <memory>
#include <optional>

#include "plugin/plugin.h"
#include "sensors/pir/band_pass.h"
#include "sensors/pir/heat.h"
#include "sensors/pir/trigger.h"

namespace angen::sensors {

/// The filtered voltage of a detector's elements. It is asleep once a constant flux has let the
/// filter come to rest.
struct PirSignal {
  BandPass band;
  double rest = 0.0;   // V: a filter nearer than this to rest is at rest
  double flux = 0.0;   // W, of the last sample, without drift
  double volts = 0.0;  // volts of that sample, without noise
  bool asleep = false;

  /// Settles as if this flux had always been there.
  void settle(double constant);
  /// Takes the next sample's flux.
  void step(double next);
};

/// A motion detector as they are built: the heat of two elements behind a Fresnel lens, filtered,
/// compared with a threshold. Its samples are computed when they are read while nothing warm moves
/// in its view.
class Pyroelectric : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override;
  std::optional<RayGeometry> rays() const override { return rays_; }
  Nanoseconds sample_period() const override { return state_.period; }
  void aim(const View& view, RayBatch& rays) override;
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override;
  Nanoseconds idle_until(const Ahead& ahead) const override;
  std::shared_ptr<const LazyReading> lazy_reading() const override;
  void skip(Nanoseconds time, const Draws&) override { state_.advance(time); }

 private:
  /// Its state after a sample, and with that its readings until something moves.
  struct Decay : LazyReading {
    PirSignal signal;
    std::shared_ptr<const HeatSources> sources = std::make_shared<HeatSources>();
    double drift = 0.0;      // W, of their flux: not seen by the filter
    double noise = 0.0;      // V, while it is awake
    double threshold = 0.0;  // V
    bool motion = false;
    Nanoseconds time = -1;  // time of the sample
    Nanoseconds period = kSecond / 100;

    double filtered_flux(Nanoseconds at) const { return sources->flux(at) - drift; }
    void advance(Nanoseconds to);
    /// When the voltage may next be beyond ±limit (V).
    Nanoseconds quiet_until(double limit) const;
    double with_noise(Rng& rng) const;
    void write(double signal_now, Reading& reading) const;
    void read(Nanoseconds to, const Draws& draws, Reading& reading) const override;
  };

  bool false_alarm(Rng& rng) const;

  Heat heat_;
  RayGeometry rays_;  // for rviz
  Decay state_;
  Trigger::Times times_;
  Trigger trigger_;
  double false_alarm_rate_ = 0.0;  // 1/h
  Nanoseconds quiet_until_ = -1;   // no sample before fires unless something moves
};

}  // namespace angen::sensors
