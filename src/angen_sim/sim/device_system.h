#pragma once

#include <functional>
#include <queue>
#include <vector>

#include "sim/building.h"
#include "sim/clock.h"
#include "sim/command.h"
#include "sim/meter.h"

namespace angen::sim {

/// The devices' part of a tick.
class DeviceSystem {
 public:
  explicit DeviceSystem(Meter& meter) : meter_(meter) {}

  /// Updates every device that is not idle, in the order in which they came into the world.
  /// `last`: how long the last tick was, for those that take long steps.
  void update(Building& building, Clock clock, Nanoseconds last, std::vector<Event>& events);

  /// The devices of a model that is awake are not idle.
  void note_awake(const LiveModel& live);

  /// States that differ from the last ones go into `next`: those of devices that had an event at
  /// once, the others 50 times a second.
  void report(Building& building, Clock clock, Snapshot& next);

  /// The end of the next tick that devices need: of one that starts when a device acts, while no
  /// body is awake. If some are `moving`, the devices that take long steps are left out, and a step
  /// ends when another acts.
  std::int64_t next_end(Building& building, Clock clock, bool moving);

  bool lights_changed() const { return lights_changed_; }

  /// To be called when devices came or went.
  void invalidate() { outdated_ = true; }

  /// To be called when devices got commands: none is idle until it was updated.
  void activate_all();

 private:
  struct Entry {
    LiveModel* live;
    DeviceInstance* device;
  };

  struct Timer {
    Nanoseconds time;
    std::uint32_t index;  // in entries_
    bool operator>(const Timer& o) const {
      return time != o.time ? time > o.time : index > o.index;
    }
  };

  void list(Building& building);
  void activate(std::uint32_t index);
  /// Activates devices whose timer has run out; active_ is in the order of entries_.
  void activate_due(Nanoseconds now);
  void make_idle(std::uint32_t index);
  void execute_commands(Building& building, Clock clock, std::vector<Event>& events);
  /// Asks a device where the limbs of its body are.
  static void place_limbs(Engines& engines, const LiveModel& live, DeviceInstance& device);
  /// The device has thrown `error`.
  static void fail(DeviceInstance& device, const std::string& error, Nanoseconds now,
                   std::vector<Event>& events);

  Meter& meter_;
  bool outdated_ = true;
  std::vector<Entry> entries_;         // indexed like Structure::devices
  std::vector<std::uint32_t> active_;  // indices of entries_ that are not surely idle
  std::vector<char> is_active_;        // indexed like entries_
  std::priority_queue<Timer, std::vector<Timer>, std::greater<>> timers_;  // timers of the others
  std::vector<std::uint32_t> to_report_;  // indices of entries_, ascending
  std::vector<std::uint32_t> had_event_;  // the ones that had an event in this tick
  std::vector<ToDevice> commands_;        // commands of devices to others, in this tick
  bool lights_changed_ = false;
};

}  // namespace angen::sim
