#pragma once

#include <cstdint>
#include <vector>

#include "sim/building.h"
#include "sim/meter.h"
#include "sim/requested_sensors.h"
#include "sim/sensor_scheduler.h"
#include "sim/view.h"

namespace angen::sim {

/// The sensors' part of a tick: those that are due aim, one cast answers all, they read. An idle
/// sensor does not sample until something in its watch region has changed, and the rays of one that
/// stands still are cast against movers only; readings are the same as if each sensor had cast all
/// its rays at each due time.
class SensorSystem {
 public:
  SensorSystem(std::uint64_t seed, const RequestedSensors& requested, Meter& meter)
      : seed_(seed), requested_(requested), meter_(meter) {}

  /// The samples of a tick.
  void sample(Building& building, InstanceView::Clock clock, std::int64_t tick, Snapshot& next);

  /// The tick that sensors need next, `tick` at the latest, while nothing moves.
  std::int64_t next_tick(Building& building, InstanceView::Clock clock, std::int64_t tick);
  /// Counts what the sensors publish in the ticks from that of `clock` up to `tick`, which
  /// next_tick() allowed to be skipped.
  void skip_to(InstanceView::Clock clock, std::int64_t tick, Snapshot& next);

  /// The sensors of a model that has moved, or is awake, are visited at their next due times.
  void note_moved(const LiveModel& live);

  /// To be called when sensors came, went, or started anew.
  void invalidate() { outdated_ = true; }

 private:
  struct Entry {
    LiveModel* live;
    SensorInstance* sensor;
  };
  struct Sample {
    std::uint32_t index;  // in Structure::sensors
    CachedScan* scan;     // null for one whose rays are in the batch
    Queried queried;      // to aim
    std::size_t first_ray;
    std::size_t ray_count;
  };

  void list(Building& building, Nanoseconds now);
  void activate(const Engines& engines, SensorScheduler::Group& group, InstanceView::Clock clock);
  void activate_changed(const Engines& engines, const SensorScheduler::Group& group);
  void activate_loud(SensorScheduler::Group& group, InstanceView::Clock clock);
  void visit_due(Building& building, const std::vector<std::uint32_t>& groups,
                 InstanceView::Clock clock, Snapshot& next);
  void publish_idle(SensorScheduler::Group& group, const Engines& engines,
                    InstanceView::Clock clock, Snapshot& next);
  void make_idle(const Engines& engines, std::uint32_t index, InstanceView::Clock clock);
  /// Whether the noise of a sample lets the sensor's lazy reading stand for it.
  bool quiet(const SensorInstance& sensor, InstanceView::Clock clock) const {
    const double chance = sensor.forecast.quiet_chance;
    return chance >= 1.0 || Rng(seed_, sensor.key, clock.time / clock.step).uniform() < chance;
  }
  Nanoseconds next_check(SensorInstance& sensor, InstanceView::Clock clock) const;
  bool skip_sample(std::uint32_t index, InstanceView::Clock clock, Snapshot& next);
  void resume(std::uint32_t index, InstanceView::Clock clock, Snapshot& next);
  static void repeat(std::uint32_t index, Snapshot& next);
  /// Whether nothing that the sensor sampled last has changed.
  static bool unchanged(const Engines& engines, const Entry& entry);
  void fail(std::uint32_t index, const std::string& error, Nanoseconds now, Snapshot& next);
  void visit(Building& building, std::uint32_t index, InstanceView::Clock clock, Snapshot& next);
  void aim(Building& building, std::uint32_t index, InstanceView::Clock clock);
  void cast(Engines& engines);
  Hits hits_of(Engines& engines, const Sample& sample, bool& same);
  void read(Building& building, const Sample& sample, InstanceView::Clock clock, std::int64_t tick,
            Snapshot& next);
  void measure(Building& building, const Sample& sample, Hits hits, InstanceView::Clock clock,
               std::int64_t tick);
  void publish(std::uint32_t index, Nanoseconds now, Snapshot& next);
  Nanoseconds next_loud(SensorInstance& sensor, InstanceView::Clock clock, Nanoseconds until) const;

  std::uint64_t seed_;
  const RequestedSensors& requested_;
  Meter& meter_;
  bool outdated_ = true;
  std::vector<Entry> entries_;         // as Structure::sensors
  SensorScheduler scheduler_;          // of these
  std::vector<Nanoseconds> checked_;   // as entries_: an idle one's noise is known until then
  std::vector<std::uint32_t> owners_;  // whose a watch region is, by its number
  std::vector<std::uint32_t> due_;
  std::vector<Sample> samples_;
  RayBatch rays_;
  std::vector<rays::Hit> hits_;
  std::vector<rays::Hit> cached_hits_;
  MoverIndex::SplitMovers split_;
};

}  // namespace angen::sim
