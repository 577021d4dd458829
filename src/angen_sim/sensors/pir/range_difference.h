#pragma once

#include <vector>

#include "plugin/plugin.h"
#include "sensors/fan.h"

namespace angen::sensors {

/// A motion detector that compares successive range scans. One that nods compares each scan with
/// the one that it took at the same height a nod ago.
class RangeDifference : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override;
  int stance(const View& view) override;
  void aim(const View& view, RayBatch& rays) override;
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override;
  Rest rest() const override;
  /// Two scans that are both within half the threshold do not differ by more than it.
  bool quiet(Rng rng) const override { return fan_.quiet(rng, threshold_ / 2.0); }
  int memory() const override { return static_cast<int>(previous_.size()); }

 private:
  std::size_t count_phases(const Params& params, double nod_period) const;

  Fan fan_;
  double threshold_ = 0.0;
  Nanoseconds period_ = kSecond;
  std::vector<std::vector<Vec3>> directions_;  // by phase of the nod
  std::vector<Ranges> previous_;               // by phase; empty before its first scan
  Nanoseconds first_time_ = 0;
  Nanoseconds last_time_ = -1;
  std::size_t phase_ = 0;
  bool motion_ = false;
  bool changes_ = true;  // the last scan differs from the one before
  std::size_t quiet_scans_ = 0;
};

}  // namespace angen::sensors
