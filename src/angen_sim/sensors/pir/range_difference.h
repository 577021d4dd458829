#pragma once

#include <vector>

#include "plugin/plugin.h"
#include "sensors/fan.h"
#include "sensors/pir/trigger.h"

namespace angen::sensors {

/// A motion detector that compares successive range scans. One that nods scans two tilts at a time,
/// its own and that of its next scan, so that the next has something to be compared with.
class RangeDifference : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override;
  std::optional<RayGeometry> rays() const override { return fan_; }
  int ray_set(const View& view) override;
  void aim(const View& view, RayBatch& rays) override;
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override;
  Nanoseconds idle_until(const Ahead& ahead) const override;
  std::shared_ptr<const LazyReading> lazy_reading() const override;
  void skip(Nanoseconds time, const Draws& draws) override;

 private:
  /// When it takes which of its scans.
  struct Nod {
    Nanoseconds period = kSecond;  // from scan to scan
    Nanoseconds first_time = 0;
    std::size_t phases = 1;
    std::size_t phase(Nanoseconds time) const {
      const Nanoseconds scans = (time - first_time + period / 2) / period;
      return static_cast<std::size_t>(scans) % phases;
    }
  };
  /// One scan with noise: the published ranges, and those that the next scan is compared with.
  struct Scan {
    Ranges ranges;
    Ranges ahead;  // at the tilt of the next scan; the same as `ranges` of one that does not nod
  };
  struct Scans;  // its lazy reading

  bool varies() const { return nod_.phases > 1 || fan_.noisy(); }
  std::size_t count_phases(const Params& params, double nod_period) const;
  static Scan scan_of(const Fan& fan, const Ranges& clean, const Rng& rng);
  static void write(Ranges ranges, double difference, double threshold, Reading& reading);

  Fan fan_;
  Nod nod_;
  double threshold_ = 0.0;
  QuietNoise quiet_;  // two scans with it do not differ by more than the threshold
  Trigger::Times times_;
  Trigger trigger_;
  std::vector<std::vector<Vec3>> directions_;  // by phase of the nod: its tilt's, the next tilt's
  std::vector<Ranges> previous_;               // by phase; empty before its first scan
  std::vector<Ranges> clean_;                  // by phase, without noise, as its directions
  Ranges ahead_;                               // the last scan's, at the tilt of this one
  Nanoseconds last_time_ = -1;
  std::size_t phase_ = 0;
  bool changes_ = true;  // the last scan differs from the one before
  std::size_t quiet_scans_ = 0;
};

}  // namespace angen::sensors
