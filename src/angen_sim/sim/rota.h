#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

#include "sim/rhythm.h"
#include "sim/sights.h"

namespace angen::sim {

/// Which sensors are to look when, by their index. Those of one rhythm are a group. Calm ones of it
/// are not gone through when it is due: they go on as they are until somebody rouses them.
class Rota {
 public:
  struct Group {
    Rhythm rhythm;                     // of all its sensors
    std::vector<std::uint32_t> awake;  // ascending
    std::vector<std::uint32_t> calm;   // as well
    Nanoseconds alarm = kForever;      // no calm one has to be looked at before for its own sake
    Sights::Moment looked = 0;         // the calm ones need not know what stirred before

    bool publishes(Nanoseconds now) const {
      return rhythm.last_publication(now) > now - rhythm.step;
    }

   private:
    friend class Rota;
    bool shifts = false;  // some are in the wrong list
  };

  /// Starts anew, with sensors that are all awake.
  void assign(const std::vector<Rhythm>& rhythms, Nanoseconds now);
  /// Time has jumped to `now`.
  void requeue(Nanoseconds now);

  /// The groups that are due at `now`, each once; they will be due again at their next look.
  const std::vector<std::uint32_t>& collect(Nanoseconds now);

  Group& group(std::uint32_t number) { return groups_[number]; }
  const std::vector<Group>& groups() const { return groups_; }
  std::uint32_t group_of(std::uint32_t sensor) const { return group_of_[sensor]; }
  bool is_calm(std::uint32_t sensor) const { return calm_[sensor] != 0; }

  /// Both hold for is_calm() at once, for the group's lists from shift() on.
  void calm(std::uint32_t sensor);
  void rouse(std::uint32_t sensor);
  void shift(Group& group);

 private:
  struct Due {
    Nanoseconds time;
    std::uint32_t group;
    bool operator>(const Due& o) const { return time != o.time ? time > o.time : group > o.group; }
  };

  void set(std::uint32_t sensor, bool calm);

  std::vector<Group> groups_;
  std::vector<std::uint32_t> group_of_;  // by sensor
  std::vector<char> calm_;               // as well
  std::priority_queue<Due, std::vector<Due>, std::greater<>> queue_;
  std::vector<std::uint32_t> due_;
};

}  // namespace angen::sim
