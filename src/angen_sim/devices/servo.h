#pragma once

#include <limits>

#include "devices/pid.h"
#include "devices/profile.h"

namespace angen::devices {

struct ServoSettings {
  Controller controller = Controller::kProfile;
  PidGains gains;
  double max_velocity = 1.0;
  double max_acceleration = 1.0;
  double inertia = 1.0;          // command per unit of acceleration, fed forward
  double damping = 0.0;          // command per unit of velocity, fed forward
  double friction = 0.0;         // command that it takes to move at all, fed forward
  double max_lag = 0.1;          // the setpoint waits when it is further ahead than this
  double arrive_error = 0.01;    // at rest means nearer than this …
  double near_error = 0.01;      // … or than this where friction has held it for kNearTime …
  double arrive_speed = 0.01;    // … and slower than this
  double stall_speed = 0.01;     // less towards the target, in the mean over kStallTime, is none
  double freed_distance = 0.02;  // moved on by this much since it was blocked means freed
  // 1/s: how fast the load is estimated, which the command then carries instead of an integral;
  // 0: it is not. For gains whose integral would swing.
  double load_rate = 0.0;
};

/// A joint led along a profile by a PID, or driven by a plain one, which has only `gains` of its
/// settings and those by which it is at rest or blocked. An obstacle to the joint makes the profile
/// wait; after kStallTime without motion it is blocked. When the obstacle is removed, the profile
/// restarts from the joint's position, so that the force gathered meanwhile does not fling it.
class Servo {
 public:
  static constexpr double kStallTime = 0.8;  // s
  static constexpr double kNearTime = 0.3;   // s

  Servo() = default;
  explicit Servo(const ServoSettings& settings);

  /// Takes over a joint at its position and velocity, under a load (of the command's unit) that
  /// acts on it.
  void start(double position, double velocity, double load = 0.0);
  /// The command (unit of gains.cmd_max) for the next dt seconds, of at most `most`.
  double update(double target, double position, double velocity, double dt,
                double most = std::numeric_limits<double>::infinity());
  /// From the joint to its setpoint at the last update.
  double lag() const { return lag_; }
  /// s for which the joint has been as far from its setpoint as it may be.
  double lagged() const { return lagged_; }
  /// The load that it has found.
  double load() const { return load_; }

  bool arrived() const { return arrived_; }
  bool blocked() const { return blocked_; }

 private:
  double feed_forward() const;
  void observe(double position, double velocity, double dt, double most);
  void free(double position, double velocity);
  void watch(double target, double position, double velocity, double dt);

  ServoSettings settings_;
  Profile profile_;
  Pid pid_;
  double lag_ = 0.0;
  double lagged_ = 0.0;  // s
  double load_ = 0.0;
  double steady_load_ = 0.0;  // when it last came on
  double acted_ = 0.0;        // the last command
  double velocity_ = 0.0;     // then
  double target_ = 0.0;
  double came_to_ = 0.0;     // position, the nearest to the target
  double stalled_ = 0.0;     // s since it came there
  double blocked_at_ = 0.0;  // position
  bool blocked_ = false;
  bool arrived_ = false;
};

}  // namespace angen::devices
