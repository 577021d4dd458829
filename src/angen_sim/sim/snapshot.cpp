#include "sim/snapshot.h"

#include <algorithm>

namespace angen::sim {

Nanoseconds Snapshot::stamp(std::size_t sensor) const {
  const SensorEntry& entry = structure->sensors[sensor];
  const Nanoseconds made = sensors[sensor].reading->stamp;
  return entry.on_demand ? made : std::max(made, entry.rhythm.last_publication(time));
}

std::shared_ptr<const Reading> Snapshot::reading(std::size_t sensor) const {
  const Told& told = sensors[sensor];
  if (told.echo == nullptr || stamp(sensor) == told.reading->stamp) return told.reading;
  auto made = std::make_shared<Reading>();
  made->kind = told.reading->kind;
  made->stamp = stamp(sensor);
  const SensorEntry& entry = structure->sensors[sensor];
  told.echo->read(made->stamp, draws_at(entry.rhythm, made->stamp, seed, entry.key), *made);
  return made;
}

}  // namespace angen::sim
