#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "sim/building.h"
#include "sim/clock.h"
#include "sim/meter.h"
#include "sim/requested_sensors.h"
#include "sim/sensor_scheduler.h"

namespace angen::sim {

/// Finds which sensors sample at their due times, and which ticks none of them needs. An idle one
/// does not sample until something in its watch region has changed.
class DueSensors {
 public:
  struct Entry {
    LiveModel* live;
    SensorInstance* sensor;
  };
  enum class Visit {
    kNothing,
    kPublish,  // publishes without a sample: its queries have not changed
    kSample,
  };

  DueSensors(std::uint64_t seed, const RequestedSensors& requested, Meter& meter)
      : seed_(seed), requested_(requested), meter_(meter) {}

  /// To be called when sensors were added, removed or reset.
  void invalidate() { outdated_ = true; }
  const Entry& operator[](std::uint32_t index) const { return entries_[index]; }

  /// Sensors due in the tick that ends now and not idle, ascending.
  const std::vector<std::uint32_t>& collect(Building& building, Clock clock);
  Visit visit(const Engines& engines, std::uint32_t index, Clock clock);
  /// After a visit for which it needs no sample.
  void make_idle(const Engines& engines, std::uint32_t index, Clock clock);
  /// Idle ones that are due publish their last readings again; ends what collect() began.
  void publish_idle(const Engines& engines, Clock clock, Snapshot& next);

  /// The sensors of a model that has moved, or is awake, are visited at their next due times.
  void note_moved(const LiveModel& live);

  /// The tick that sensors need next, `tick` at the latest, while no body moves.
  std::int64_t next_tick(Building& building, Clock clock, std::int64_t tick);
  /// Counts the publications of the ticks from that of `clock` up to `tick`, which
  /// next_tick() allowed to be skipped.
  void skip_to(Clock clock, std::int64_t tick, Snapshot& next);

 private:
  void list(Building& building, Nanoseconds now);
  void activate(const Engines& engines, SensorScheduler::Group& group, Clock clock);
  void activate_changed(const Engines& engines, const SensorScheduler::Group& group);
  void activate_for_events(SensorScheduler::Group& group, Clock clock);
  /// Whether the sensor's lazy reading can replace a sample: no event is due, nor by its noise.
  bool has_no_event(const SensorInstance& sensor, Clock clock) const {
    const double probability = sensor.forecast.no_event_probability;
    if (clock.time >= sensor.forecast.next_event) return false;
    return probability >= 1.0 ||
           Rng(seed_, sensor.key, clock.time / clock.step).uniform() < probability;
  }
  Nanoseconds next_possible_event(SensorInstance& sensor, Clock clock, Nanoseconds until) const;
  Nanoseconds next_check(SensorInstance& sensor, Clock clock) const;
  bool needs_no_sample(SensorInstance& sensor, Clock clock) const;
  /// Whether all that the sensor sampled last is unchanged.
  static bool unchanged(const Engines& engines, const Entry& entry);

  std::uint64_t seed_;
  const RequestedSensors& requested_;
  Meter& meter_;
  bool outdated_ = true;
  std::vector<Entry> entries_;         // indexed like Structure::sensors
  SensorScheduler scheduler_;          // schedules of these
  std::vector<Nanoseconds> checked_;   // like entries_: an idle one's noise is known until then
  std::vector<std::uint32_t> owners_;  // whose a watch region is, by its number
  std::vector<std::uint32_t> groups_;  // groups that are due
  std::vector<std::uint32_t> due_;
};

/// Entries from `middle` on were appended; both parts ascend.
inline void merge_from(std::vector<std::uint32_t>& list, std::size_t middle) {
  std::inplace_merge(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(middle), list.end());
}

// Values on which a sensor's samples depend, besides rays.
Pose pose_of(const Engines& engines, const LiveModel& live, const SensorInstance& sensor);
std::uint64_t contacts_revision(const Engines& engines, const SensorInstance& sensor);

}  // namespace angen::sim
