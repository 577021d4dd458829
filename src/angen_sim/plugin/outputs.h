#pragma once

#include <string>

#include "core/pose.h"
#include "plugin/parts.h"

namespace angen {

/// Effects of a device on the world in one tick.
class Outputs {
 public:
  virtual ~Outputs() = default;
  /// N m or N, for this tick only; wakes the bodies unless 0.
  virtual void force(JointRef joint, double force) = 0;
  /// Velocity motor with a force limit, until changed. Velocity 0 is a brake; max_force 0 frees.
  virtual void motor(JointRef joint, double velocity, double max_force) = 0;
  /// Holds a joint where it is against less than `break_force` (N m or N, may be infinite), until
  /// unlatch().
  virtual void latch(JointRef joint, double break_force) = 0;
  virtual void unlatch(JointRef joint) = 0;
  /// Horizontal velocity (m/s) and yaw rate (rad/s) by a motor of at most max_force (N).
  virtual void drive(LinkRef link, const Vec3& velocity, double yaw_rate, double max_force) = 0;
  /// From now on the collisions of that posture, in Anatomy::postures, touch and are hit by rays,
  /// and the link is at `at` (world), at rest.
  virtual void posture(LinkRef, int, const Pose&) {}
  /// A force (N) at a point (world, m) and a torque (N m) on a link, for this tick only. Wakes a
  /// sleeping body unless both are 0; an awake one may fall asleep under the same push.
  virtual void push(LinkRef link, const Vec3& force, const Vec3& torque, const Vec3& point) = 0;
  /// Light level 0..1 and the flux in lm at level 1.
  virtual void light(LightRef light, double level, double luminous_flux) = 0;
  /// Temperature (K) of a surface, as PIRs see it: from `now` it approaches `limit` exponentially,
  /// with a time constant in s (0 = it is there at once). Holds until it is set again.
  virtual void temperature(SurfaceRef surface, double now, double limit, double time_constant) = 0;
  /// Commands another device of this world, as a hand on it does. It is executed at the end of this
  /// tick's updates; a rejection is an event.
  virtual void command(const std::string& kind, const std::string& name,
                       const std::string& text) = 0;
  /// Published on /angen/events.
  virtual void event(const std::string& event, const std::string& detail) = 0;
};

}  // namespace angen
