#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

#include "sim/mover_index.h"
#include "sim/schedule.h"
#include "sim/state_changes.h"

namespace angen::sim {

/// Knows which sensors, by index, sample when. Sensors with the same schedule are a group. Idle
/// ones are not visited when their group is due, until they are activated.
class SensorScheduler {
 public:
  struct Group {
    Schedule schedule;                  // schedule of all its sensors
    std::vector<std::uint32_t> active;  // ascending
    std::vector<std::uint32_t> idle;    // idle sensors, ascending
    Nanoseconds idle_until = kForever;  // until then no idle sensor is to be queried
    bool queries_devices = false;       // whether some idle sensors query devices
    StateChanges::Fields fields = 0;    // fields by which they do
    Heights heights;                    // heights at which they do
    MoverIndex::Moment checked = 0;     // idle ones were activated for all changes before

    bool publishes(Nanoseconds now) const {
      return schedule.last_publication(now) > now - schedule.step;
    }

   private:
    friend class SensorScheduler;
    bool outdated = false;  // some are in the wrong list
  };

  /// Starts again, with all sensors active.
  void assign(const std::vector<Schedule>& schedules, Nanoseconds now);
  /// Time has jumped to `now`.
  void requeue(Nanoseconds now);

  /// The groups that are due at `now`, each once; they will be due again at their next sample.
  const std::vector<std::uint32_t>& collect(Nanoseconds now);

  Group& group(std::uint32_t number) { return groups_[number]; }
  const std::vector<Group>& groups() const { return groups_; }
  std::uint32_t group_of(std::uint32_t sensor) const { return group_of_[sensor]; }
  bool is_idle(std::uint32_t sensor) const { return idle_[sensor] != 0; }

  /// Both take effect in is_idle() at once, in the group's lists at update_lists().
  void make_idle(std::uint32_t sensor);
  void activate(std::uint32_t sensor);
  void update_lists(Group& group);

 private:
  struct Due {
    Nanoseconds time;
    std::uint32_t group;
    bool operator>(const Due& o) const { return time != o.time ? time > o.time : group > o.group; }
  };

  void set(std::uint32_t sensor, bool idle);

  std::vector<Group> groups_;
  std::vector<std::uint32_t> group_of_;  // by sensor
  std::vector<char> idle_;               // indexed by sensor
  std::priority_queue<Due, std::vector<Due>, std::greater<>> queue_;
  std::vector<std::uint32_t> due_;
};

}  // namespace angen::sim
