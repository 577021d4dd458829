#pragma once

#include "angen_sim/devices/models.h"
#include "angen_sim/devices/rig.h"

namespace angen::test {

inline Rig& add_door(Bench& bench, const DoorMeasures& measures = {},
                     const Parameters& parameters = {}) {
  return bench.add(door(measures), "libdoor_world_plugin.so", "door", parameters);
}

inline double angle(const Rig& door) { return door.at("hinge").position; }

}  // namespace angen::test
