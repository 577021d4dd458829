#pragma once

#include <algorithm>

#include "plugin/params.h"

namespace angen::devices {

/// Gazebo's seven numbers. The output is in the unit of cmd_max; i_max and i_min limit the
/// integral's share of it.
struct PidGains {
  double p = 0.0;
  double i = 0.0;
  double d = 0.0;
  double i_max = 0.0;
  double i_min = 0.0;
  double cmd_max = 0.0;
  double cmd_min = 0.0;
};

/// Units of the numbers; i_max … cmd_min share the command's unit.
struct PidUnits {
  const char* p;
  const char* i;
  const char* d;
  const char* command;
};

/// The seven as parameters; `fallback` has the default values.
PidGains read_gains(Params& params, const PidGains& fallback, const PidUnits& units);

/// The control law of a joint: <controller>.
enum class Controller {
  kProfile,  // a Servo's: a setpoint that is led along a profile, and feed-forward
  kPid       // P + I + D of the distance to the target
};
Controller read_controller(Params& params);

class Pid {
 public:
  Pid() = default;
  explicit Pid(const PidGains& gains) : gains_(gains) {}

  /// The command for an error (setpoint minus measured) and its rate, with a feed-forward in the
  /// command's unit, after dt seconds. While the command is cut off the integral only shrinks.
  double update(double error, double error_rate, double feed_forward, double dt,
                bool integrate = true) {
    const double more = integrate ? gains_.i * error * dt : 0.0;
    const double grown = std::clamp(integral_ + more, gains_.i_min, gains_.i_max);
    const double rest = gains_.p * error + gains_.d * error_rate + feed_forward;
    const double unlimited = rest + grown;
    const bool winds_up = (unlimited > gains_.cmd_max && grown > integral_) ||
                          (unlimited < gains_.cmd_min && grown < integral_);
    if (!winds_up) integral_ = grown;
    return std::clamp(rest + integral_, gains_.cmd_min, gains_.cmd_max);
  }

  /// P + I + D and nothing else, as Gazebo's own class has it: only the integral's share and the
  /// sum have limits.
  double update_plain(double error, double error_rate, double dt) {
    integral_ = std::clamp(integral_ + gains_.i * error * dt, gains_.i_min, gains_.i_max);
    return std::clamp(gains_.p * error + integral_ + gains_.d * error_rate, gains_.cmd_min,
                      gains_.cmd_max);
  }

  void reset() { integral_ = 0.0; }
  double integral() const { return integral_; }  // its share of the command

 private:
  PidGains gains_;
  double integral_ = 0.0;
};

}  // namespace angen::devices
