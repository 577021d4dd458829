#pragma once

#include <vector>

#include "core/time.h"
#include "core/warming.h"
#include "rays/scene.h"
#include "sim/mover_index.h"

namespace angen::sim {

/// Surfaces whose temperature devices set. One that changes is evaluated when a sensor queries it,
/// so without such a sensor it costs nothing, and its temperature depends on the time alone.
class SurfaceTemperatures {
 public:
  using Moment = MoverIndex::Moment;

  explicit SurfaceTemperatures(rays::Scene& rays) : rays_(rays) {}

  /// From `temperature` (K) at `now` to `limit`, exponentially with `time_constant` in s.
  void set(rays::ShapeId shape, double temperature, double limit, double time_constant,
           Nanoseconds now, Moment moment);
  void remove(rays::ShapeId shape);

  /// Finds the surfaces that have come to their limits by `now`.
  void advance(Nanoseconds now, Moment moment);

  /// Whether one changes now, or was set or has come to its limit at `since` or later.
  bool changed_since(Moment since) const { return !changing_.empty() || changed_ >= since; }
  /// The same of those that are in a box (m, world).
  bool changed_since(Moment since, const Eigen::AlignedBox3d& within) const;
  /// Whether one was set at `since` or later.
  bool set_since(Moment since) const { return set_ >= since; }
  /// The same of those that are in a box.
  bool set_since(Moment since, const Eigen::AlignedBox3d& within) const;
  /// The number of calls that set one.
  std::uint64_t times_set() const { return times_set_; }

 private:
  struct Changing {
    rays::ShapeId shape;
    Warming course;
    bool arrived = false;
  };

  struct Change {
    rays::ShapeId shape;
    Moment moment;
    Moment set;  // the last time that it was set
  };

  Change& note_changed(rays::ShapeId shape, Moment moment);
  template <class Test>
  bool any_changed(Moment since, const Test& test) const;

  rays::Scene& rays_;
  std::vector<Changing> changing_;
  std::vector<Change> changes_;  // the last of each, in the order of their moments
  Moment changed_ = 0;
  Moment set_ = 0;  // the last of all
  std::uint64_t times_set_ = 0;
};

}  // namespace angen::sim
