#pragma once

#include <vector>

#include "sim/building.h"
#include "sim/view.h"

namespace angen::sim {

/// The devices' part of a tick.
class Acting {
 public:
  /// Every device acts, in the order in which they came into the world.
  void act(Building& building, InstanceView::Clock clock, std::vector<Event>& events);

  /// States that differ from the last ones go into `next`: those of devices that told an event at
  /// once, the others 50 times a second.
  void report(Building& building, InstanceView::Clock clock, Snapshot& next);

  bool lights_changed() const { return lights_changed_; }

 private:
  std::vector<const DeviceInstance*> told_;
  bool lights_changed_ = false;
};

}  // namespace angen::sim
