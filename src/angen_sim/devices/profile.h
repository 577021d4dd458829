#pragma once

namespace angen::devices {

/// A setpoint that moves to its target with limited velocity and acceleration (a trapezoid of
/// velocity) and arrives there exactly, at rest. The target may change on the way.
class Profile {
 public:
  Profile() = default;
  /// Limits in units per s and per s^2, both positive.
  Profile(double max_velocity, double max_acceleration)
      : max_velocity_(max_velocity), max_acceleration_(max_acceleration) {}

  /// Puts the setpoint somewhere, moving or not.
  void start(double position, double velocity = 0.0);
  /// One step of dt seconds towards `target`.
  void advance(double target, double dt);

  double position() const { return position_; }
  double velocity() const { return velocity_; }
  double acceleration() const { return acceleration_; }  // acceleration of the last step
  bool at(double target) const { return position_ == target && velocity_ == 0.0; }

 private:
  double max_velocity_ = 1.0;
  double max_acceleration_ = 1.0;
  double position_ = 0.0;
  double velocity_ = 0.0;
  double acceleration_ = 0.0;
};

}  // namespace angen::devices
