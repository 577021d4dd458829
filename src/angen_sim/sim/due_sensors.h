#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "sim/building.h"
#include "sim/clock.h"
#include "sim/requested_sensors.h"
#include "sim/sensor_scheduler.h"

namespace angen::sim {

/// Finds which sensors sample at their due times, and which ticks none of them needs. Each sensor
/// answers one question, Sensor::idle_until(); until then, or until something that it queried has
/// changed, its last reading or its lazy one replaces its samples.
class DueSensors {
 public:
  struct Entry {
    LiveModel* live;
    SensorInstance* sensor;
  };
  enum class Visit { kNothing, kRepeat, kSample };

  DueSensors(std::uint64_t seed, const RequestedSensors& requested)
      : seed_(seed), requested_(requested) {}

  /// To be called when sensors were added, removed or reset.
  void invalidate() { outdated_ = true; }
  const Entry& operator[](std::uint32_t index) const { return entries_[index]; }

  /// Sensors to visit in the tick that ends now, ascending.
  const std::vector<std::uint32_t>& collect(Building& building, Clock clock);
  /// What the sensor does at this due time. One that repeats its reading, and that only changes in
  /// its watch regions, of its model, or of devices that it queries, can wake, is not visited again
  /// until then.
  Visit visit(const Engines& engines, std::uint32_t index, Clock clock, Snapshot& next);
  /// Whether its reading stays although something moves in its region. The hits of its rays must
  /// be as at its last sample; it must depend on nothing else but time.
  bool stays(std::uint32_t index, Clock clock);
  /// The sensor has sampled. Whether its next sample would be the same, but for noise.
  bool note_sampled(std::uint32_t index, Clock clock);
  /// From now on the sensor repeats its reading, if that is the last one, or makes it when it is
  /// read. Returns false if its next sample may be another, or if it has yet to publish this one.
  bool begin_idle(std::uint32_t index, Clock clock, Snapshot& next);
  /// Sensors that are due and were not visited publish their last readings again; ends what
  /// collect() began.
  void publish_idle(const Engines& engines, Clock clock, Snapshot& next);

  /// The sensors of a model that has moved, or is awake, are visited at their next due times.
  void note_moved(const LiveModel& live);

  /// The end of the next tick that sensors need, `end` at the latest. While something is `moving`,
  /// a sensor for which something had changed at its last sample needs the next one, too.
  std::int64_t next_end(Building& building, Clock clock, std::int64_t end, bool moving);
  /// Counts the publications of the ticks from that of `clock` up to `tick`, which
  /// next_end() allowed to be skipped.
  void skip_to(Clock clock, std::int64_t tick, Snapshot& next);
  /// To be called before the sensor gets its error.
  void note_failing(std::uint32_t index);

 private:
  void list(Building& building, Nanoseconds now);
  bool counts(std::uint32_t index) const;
  void activate(const Engines& engines, SensorScheduler::Group& group, Clock clock);
  void activate_changed(const Engines& engines, const SensorScheduler::Group& group);
  void renew_idle_until(SensorScheduler::Group& group) const;
  bool is_idle(std::uint32_t index, Clock clock);
  Nanoseconds idle_until(SensorInstance& sensor, Nanoseconds after) const;
  void stop_visits(const Engines& engines, std::uint32_t index);
  /// Whether all that the sensor sampled last is unchanged.
  static bool unchanged(const Engines& engines, const Entry& entry);

  std::uint64_t seed_;
  const RequestedSensors& requested_;
  bool outdated_ = true;
  std::vector<Entry> entries_;           // indexed like Structure::sensors
  SensorScheduler scheduler_;            // schedules of these
  std::vector<std::uint64_t> counted_;   // by group: how many publish at all its times
  std::vector<Nanoseconds> idle_until_;  // their answers, indexed like entries_
  std::vector<std::uint32_t> owners_;    // whose a watch region is, by its number
  std::vector<std::uint32_t> groups_;    // groups that are due
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
