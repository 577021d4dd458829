#include "sim/snapshot.h"

#include <algorithm>

namespace angen::sim {

Nanoseconds Snapshot::stamp(std::size_t sensor) const {
  const SensorEntry& entry = structure->sensors[sensor];
  const Nanoseconds made = sensors[sensor]->stamp;
  return entry.on_demand ? made : std::max(made, entry.rhythm.last_publication(time));
}

}  // namespace angen::sim
