#pragma once

#include <vector>

#include "core/time.h"
#include "sim/edit.h"

namespace angen::sim {

class Engines;
struct LiveModel;

/// Forces and efforts that act for a time. A pushed body does not fall asleep meanwhile.
class Pushes {
 public:
  /// World frame; the force acts at the link's center of mass.
  void add(const LiveModel& model, std::uint32_t link, const Vec3& force, const Vec3& torque,
           const PushTime& time);
  void add(const LiveModel& model, std::uint32_t joint, double effort, const PushTime& time);
  void clear_link(const LiveModel& model, std::uint32_t link);
  void clear_joint(const LiveModel& model, std::uint32_t joint);
  /// The model is removed.
  void forget(const LiveModel& model);
  void clear() { pushes_.clear(); }

  /// Before the step that begins at `now`.
  void apply(Engines& engines, Nanoseconds now, Nanoseconds step);
  /// When the next one begins or acts, at or after `now`; kForever without any.
  Nanoseconds next(Nanoseconds now) const;

 private:
  struct Push {
    const LiveModel* model;
    bool on_joint;
    std::uint32_t index;  // index of the link or joint
    Vec3 force;
    Vec3 torque;
    double effort;
    Nanoseconds start;
    Nanoseconds duration;
    std::int64_t ticks;  // taken
  };

  std::vector<Push> pushes_;  // in the order in which they came
};

}  // namespace angen::sim
