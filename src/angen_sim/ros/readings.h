#pragma once

#include <memory>
#include <vector>

#include "sim/snapshot.h"

namespace angen::node {

/// The last readings of sensors, as Snapshot::reading() returns them: one that was computed is kept
/// until its next, for all topics that want it. Of the thread that publishes.
class Readings {
 public:
  std::shared_ptr<const Reading> of(const sim::Snapshot& snapshot, std::uint32_t sensor) {
    const sim::PublishedReading& published = snapshot.sensors[sensor];
    if (published.lazy == nullptr) return published.reading;
    if (snapshot.structure != structure_) {
      structure_ = snapshot.structure;
      made_.assign(structure_->sensors.size(), {});
    }
    Made& made = made_[sensor];
    const Nanoseconds stamp = snapshot.stamp(sensor);
    if (made.by != published.lazy || made.reading->stamp != stamp) {
      made = {published.lazy, snapshot.reading(sensor)};
    }
    return made.reading;
  }

 private:
  struct Made {
    std::shared_ptr<const LazyReading> by;
    std::shared_ptr<const Reading> reading;
  };

  std::shared_ptr<const sim::Structure> structure_;
  std::vector<Made> made_;  // indexed like Structure::sensors
};

}  // namespace angen::node
