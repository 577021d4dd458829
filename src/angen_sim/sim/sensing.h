#pragma once

#include <cstdint>
#include <queue>
#include <vector>

#include "sim/building.h"
#include "sim/demand.h"
#include "sim/meter.h"
#include "sim/view.h"

namespace angen::sim {

/// The sensors' part of a tick: those that are due aim, one cast answers all, they read. One at
/// rest is not asked again before something that it looks at has changed, and the rays of one that
/// stands still are cast against movers only; the readings are the same as if each had cast all its
/// rays.
class Sensing {
 public:
  Sensing(std::uint64_t seed, const Demand& demand, Meter& meter)
      : seed_(seed), demand_(demand), meter_(meter) {}

  void look(Building& building, InstanceView::Clock clock, std::int64_t tick, Snapshot& next);

  /// The tick that must be taken next for a sensor's sake, `tick` at the latest, while nothing
  /// moves.
  std::int64_t next_tick(Building& building, InstanceView::Clock clock, std::int64_t tick);
  /// What the sensors do in the ticks from that of `clock` up to `tick`, which next_tick() allowed.
  void pass_over(InstanceView::Clock clock, std::int64_t tick, Snapshot& next);

  /// To be called when sensors came, went, or started anew.
  void invalidate() { schedule_is_old_ = true; }

 private:
  struct Watched {
    LiveModel* live;
    SensorInstance* sensor;
  };
  /// Sensors that look at the same times.
  struct Group {
    Nanoseconds due;
    std::uint32_t index;  // in groups_
    bool operator>(const Group& o) const { return due != o.due ? due > o.due : index > o.index; }
  };
  struct Looking {
    std::uint32_t index;  // in Structure::sensors
    Look* look;           // null for one whose rays are in the batch
    bool asked_more;      // of the view, to aim
    bool asked_devices;
    std::size_t first_ray;
    std::size_t ray_count;
  };

  /// A sensor at rest that publishes the same again, or has its echo do so, while nothing stirs in
  /// its one view. With many sensors it comes from far away, and this is all that is looked at.
  struct Calm {
    std::uint32_t view = UINT32_MAX;  // none: it is to be visited
    Sights::Moment seen = 0;
    Rhythm rhythm;
    std::uint64_t key = 0;
    double quiet_chance = 1.0;
  };

  void schedule(Building& building, Nanoseconds now);
  /// Whether the noise of the look at `at` lets the sensor go on as it does.
  bool quiet(std::uint64_t key, double chance, Nanoseconds at, Nanoseconds step) const {
    return chance >= 1.0 || Rng(seed_, key, at / step).uniform() < chance;
  }
  bool goes_on(std::uint32_t index, InstanceView::Clock clock, Snapshot& next);
  void resume(std::uint32_t index, InstanceView::Clock clock, Snapshot& next);
  bool keeps_calm(const Stage& stage, std::uint32_t index, Nanoseconds now, Snapshot& next);
  void calm_down(std::uint32_t index);
  static void repeat(std::uint32_t index, Snapshot& next);
  void requeue(Nanoseconds now);
  bool collect_due(Nanoseconds now);
  /// Whether a look would find what the last one did, noise and changing stances aside.
  static bool undisturbed(const Stage& stage, const SensorInstance& sensor);
  void visit(Building& building, std::uint32_t index, InstanceView::Clock clock, Snapshot& next);
  void aim(Building& building, std::uint32_t index, InstanceView::Clock clock);
  void cast(Stage& stage);
  Hits hits_of(Stage& stage, const Looking& looking, bool& same);
  void read(Building& building, const Looking& looking, InstanceView::Clock clock,
            std::int64_t tick, Snapshot& next);
  void publish(std::uint32_t index, Nanoseconds now, Snapshot& next);
  bool may_be_passed_over(const Stage& stage, const SensorInstance& sensor) const;
  Nanoseconds first_loud(SensorInstance& sensor, InstanceView::Clock clock,
                         Nanoseconds until) const;

  std::uint64_t seed_;
  const Demand& demand_;
  Meter& meter_;
  bool schedule_is_old_ = true;
  std::vector<Watched> watched_;                    // as Structure::sensors
  std::vector<Calm> calm_;                          // as well
  std::vector<std::vector<std::uint32_t>> groups_;  // of watched_, ascending
  std::priority_queue<Group, std::vector<Group>, std::greater<>> queue_;
  std::vector<std::uint32_t> due_;
  std::vector<Looking> looking_;
  RayBatch rays_;
  std::vector<rays::Hit> hits_;
  std::vector<rays::Hit> gaze_hits_;
  Sights::Parted parted_;
};

}  // namespace angen::sim
