#pragma once

#include <cstdint>
#include <vector>

#include "sim/due_sensors.h"
#include "sim/meter.h"

namespace angen::sim {

/// The sensors' part of a tick: those that are due aim, one cast answers all, they read. The
/// rays of a sensor that does not move are cast against movers only; readings are the same as if
/// each sensor had cast all its rays at each due time.
class SensorSystem {
 public:
  SensorSystem(std::uint64_t seed, const RequestedSensors& requested, Meter& meter)
      : seed_(seed), meter_(meter), due_(seed, requested) {}

  /// The samples of a tick.
  void sample(Building& building, Clock clock, std::int64_t tick, Snapshot& next);
  DueSensors& due() { return due_; }

 private:
  struct Sample {
    std::uint32_t index;  // in Structure::sensors
    CachedScan* scan;     // null for one whose rays are in the batch
    Queried queried;      // to aim
    std::size_t first_ray;
    std::size_t ray_count;
  };

  void visit(Building& building, std::uint32_t index, Clock clock, Snapshot& next);
  void begin_sample(Building& building, std::uint32_t index, Clock clock, Snapshot& next);
  void aim(Building& building, std::uint32_t index, Clock clock);
  void cast(Engines& engines);
  void read(Building& building, const Sample& sample, Clock clock, std::int64_t tick,
            Snapshot& next);
  Queried measure(Building& building, const Sample& sample, Hits hits, Clock clock,
                  std::int64_t tick) const;
  void note_sampled(const Engines& engines, const Sample& sample, const Queried& queried,
                    Clock clock);
  void publish(std::uint32_t index, Nanoseconds now, Snapshot& next);
  static void repeat(std::uint32_t index, Snapshot& next);
  void end_idle(std::uint32_t index, Clock clock, Snapshot& next);
  void fail(std::uint32_t index, const std::string& error, Nanoseconds now, Snapshot& next);

  std::uint64_t seed_;
  Meter& meter_;
  DueSensors due_;
  std::vector<Sample> samples_;
  RayBatch rays_;
  std::vector<rays::Hit> hits_;
  std::vector<rays::Hit> cached_hits_;
  MoverIndex::SplitMovers split_;
};

}  // namespace angen::sim
