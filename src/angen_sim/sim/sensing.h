#pragma once

#include <cstdint>
#include <vector>

#include "sim/building.h"
#include "sim/demand.h"
#include "sim/meter.h"
#include "sim/rota.h"
#include "sim/view.h"

namespace angen::sim {

/// The sensors' part of a tick: those that are due aim, one cast answers all, they read. One at
/// rest is not asked again before something that it looks at has changed, and the rays of one that
/// stands still are cast against movers only; the readings are the same as if each had cast all its
/// rays.
class Sensing {
 public:
  Sensing(std::uint64_t seed, const Demand& demand, Meter& meter)
      : seed_(seed), demand_(demand), meter_(meter) {}

  void look(Building& building, InstanceView::Clock clock, std::int64_t tick, Snapshot& next);

  /// The tick that must be taken next for a sensor's sake, `tick` at the latest, while nothing
  /// moves.
  std::int64_t next_tick(Building& building, InstanceView::Clock clock, std::int64_t tick);
  /// What the sensors do in the ticks from that of `clock` up to `tick`, which next_tick() allowed.
  void pass_over(InstanceView::Clock clock, std::int64_t tick, Snapshot& next);

  /// To be called when sensors came, went, or started anew.
  void invalidate() { schedule_is_old_ = true; }

 private:
  struct Watched {
    LiveModel* live;
    SensorInstance* sensor;
  };
  struct Looking {
    std::uint32_t index;  // in Structure::sensors
    Look* look;           // null for one whose rays are in the batch
    Asked asked;          // to aim
    std::size_t first_ray;
    std::size_t ray_count;
  };

  void schedule(Building& building, Nanoseconds now);
  void rouse(const Stage& stage, Rota::Group& group, InstanceView::Clock clock);
  void rouse_stirred(const Stage& stage, const Rota::Group& group);
  void rouse_loud(Rota::Group& group, InstanceView::Clock clock);
  void visit_due(Building& building, const std::vector<std::uint32_t>& groups,
                 InstanceView::Clock clock, Snapshot& next);
  void go_on(Rota::Group& group, const Stage& stage, InstanceView::Clock clock, Snapshot& next);
  void calm_down(const Stage& stage, std::uint32_t index, InstanceView::Clock clock);
  /// Whether the noise of a look lets the sensor's echo stand for it.
  bool quiet(const SensorInstance& sensor, InstanceView::Clock clock) const {
    if (sensor.quiet_chance >= 1.0) return true;
    return Rng(seed_, sensor.key, clock.time / clock.step).uniform() < sensor.quiet_chance;
  }
  Nanoseconds alarm_of(SensorInstance& sensor, InstanceView::Clock clock) const;
  bool goes_on(std::uint32_t index, InstanceView::Clock clock, Snapshot& next);
  void resume(std::uint32_t index, InstanceView::Clock clock, Snapshot& next);
  static void repeat(std::uint32_t index, Snapshot& next);
  /// Whether a look would find what the last one did, noise and changing stances aside.
  static bool undisturbed(const Stage& stage, const Watched& watched);
  void visit(Building& building, std::uint32_t index, InstanceView::Clock clock, Snapshot& next);
  void aim(Building& building, std::uint32_t index, InstanceView::Clock clock);
  void cast(Stage& stage);
  Hits hits_of(Stage& stage, const Looking& looking, bool& same);
  void read(Building& building, const Looking& looking, InstanceView::Clock clock,
            std::int64_t tick, Snapshot& next);
  void publish(std::uint32_t index, Nanoseconds now, Snapshot& next);
  bool may_be_passed_over(const Stage& stage, const Watched& watched) const;
  Nanoseconds first_loud(SensorInstance& sensor, InstanceView::Clock clock,
                         Nanoseconds until) const;

  std::uint64_t seed_;
  const Demand& demand_;
  Meter& meter_;
  bool schedule_is_old_ = true;
  std::vector<Watched> watched_;     // as Structure::sensors
  Rota rota_;                        // of these
  std::vector<Nanoseconds> alarms_;  // as watched_: noise of a calm one was looked at until then
  std::vector<std::uint32_t> watcher_of_;  // whose a view is, by its number
  std::vector<std::uint32_t> due_;
  std::vector<Looking> looking_;
  RayBatch rays_;
  std::vector<rays::Hit> hits_;
  std::vector<rays::Hit> gaze_hits_;
  Sights::Parted parted_;
};

}  // namespace angen::sim
