#pragma once

#include <cstdint>
#include <vector>

#include "sim/building.h"
#include "sim/demand.h"
#include "sim/view.h"

namespace angen::sim {

/// The sensors' part of a tick: those that are due aim, one cast answers all, they read.
class Sensing {
 public:
  Sensing(std::uint64_t seed, const Demand& demand) : seed_(seed), demand_(demand) {}

  void look(Building& building, InstanceView::Clock clock, std::int64_t tick, Snapshot& next);

  /// Forgets what is due when; to be called when sensors came, went, or started anew.
  void invalidate() { earliest_ = 0; }

 private:
  struct Due {
    LiveModel* live;
    std::size_t sensor;
    std::size_t first_ray;
    std::size_t ray_count;
  };

  void aim(Building& building, InstanceView::Clock clock);
  void read(Building& building, const Due& due, InstanceView::Clock clock, std::int64_t tick,
            Snapshot& next);

  std::uint64_t seed_;
  const Demand& demand_;
  Nanoseconds earliest_ = 0;  // no sensor is due before
  std::vector<Due> due_;
  RayBatch rays_;
  std::vector<rays::Hit> hits_;
};

}  // namespace angen::sim
