#pragma once

#include <functional>
#include <queue>
#include <vector>

#include "sim/building.h"
#include "sim/meter.h"
#include "sim/view.h"

namespace angen::sim {

/// The devices' part of a tick.
class Acting {
 public:
  explicit Acting(Meter& meter) : meter_(meter) {}

  /// Every device that is not idle acts, in the order in which they came into the world.
  void act(Building& building, InstanceView::Clock clock, std::vector<Event>& events);

  /// After physics has made tick number `tick`: what is awake keeps its devices from being idle.
  void note_awake(Building& building, std::int64_t tick);

  /// States that differ from the last ones go into `next`: those of devices that told an event at
  /// once, the others 50 times a second.
  void report(Building& building, InstanceView::Clock clock, Snapshot& next);

  /// The tick that must be taken next for a device's sake, while nothing is awake.
  std::int64_t next_tick(Building& building, InstanceView::Clock clock);

  bool lights_changed() const { return lights_changed_; }

  /// To be called when devices came or went.
  void invalidate() { list_is_old_ = true; }

  /// To be called when devices got commands: none is idle until it has been looked at.
  void rouse_all();

 private:
  struct Part {
    LiveModel* live;
    DeviceInstance* device;
  };

  struct Alarm {
    Nanoseconds time;
    std::uint32_t index;  // in parts_
    bool operator>(const Alarm& o) const {
      return time != o.time ? time > o.time : index > o.index;
    }
  };

  void list(Building& building);
  void rouse(std::uint32_t index);
  /// Those whose time has come; of what acts, the order is that of parts_.
  void rouse_due(Nanoseconds now);
  void rest(std::uint32_t index);

  Meter& meter_;
  bool list_is_old_ = true;
  std::vector<Part> parts_;          // as Structure::devices
  std::vector<std::uint32_t> busy_;  // of parts_: those that are not surely idle
  std::vector<char> is_busy_;        // as parts_
  std::priority_queue<Alarm, std::vector<Alarm>, std::greater<>> alarms_;  // of the others
  std::vector<std::uint32_t> to_report_;                                   // of parts_, ascending
  std::vector<std::uint32_t> told_;  // those of them that told an event in this tick
  std::vector<physics::LinkId> awake_;
  bool lights_changed_ = false;
};

}  // namespace angen::sim
