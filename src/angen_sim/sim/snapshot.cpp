#include "sim/snapshot.h"

#include <algorithm>

namespace angen::sim {

std::uint32_t Structure::first_link(std::uint32_t model) const {
  const auto first =
      std::lower_bound(links.begin(), links.end(), model,
                       [](const LinkEntry& link, std::uint32_t m) { return link.model < m; });
  return static_cast<std::uint32_t>(first - links.begin());
}

Nanoseconds Snapshot::stamp(std::size_t sensor) const {
  if (sensors[sensor].stamp >= 0) return sensors[sensor].stamp;
  const SensorEntry& entry = structure->sensors[sensor];
  const Nanoseconds made = sensors[sensor].reading->stamp;
  return entry.on_demand() ? made : std::max(made, entry.schedule.last_publication(time));
}

std::shared_ptr<const Reading> Snapshot::reading(std::size_t sensor) const {
  const PublishedReading& published = sensors[sensor];
  if (published.lazy == nullptr || stamp(sensor) == published.reading->stamp)
    return published.reading;
  auto made = std::make_shared<Reading>();
  made->kind = published.reading->kind;
  made->stamp = stamp(sensor);
  made->fields = published.reading->fields;  // a number is set to an integer as there
  const SensorEntry& entry = structure->sensors[sensor];
  published.lazy->read(made->stamp, draws_at(entry.schedule, made->stamp, seed, entry.key), *made);
  return made;
}

}  // namespace angen::sim
