#include "devices/pid.h"

namespace angen::devices {

PidGains read_gains(Params& params, const PidGains& fallback, const PidUnits& units) {
  constexpr Range kNotPositive{-1e9, 0.0};
  PidGains gains;
  gains.p = params.number("p", fallback.p, units.p, "proportional gain", kNotNegative);
  gains.i = params.number("i", fallback.i, units.i, "integral gain", kNotNegative);
  gains.d = params.number("d", fallback.d, units.d, "derivative gain", kNotNegative);
  gains.i_max = params.number("i_max", fallback.i_max, units.command,
                              "limit of the integral's share", kNotNegative);
  gains.i_min = params.number("i_min", fallback.i_min, units.command,
                              "limit of the integral's share", kNotPositive);
  gains.cmd_max =
      params.number("cmd_max", fallback.cmd_max, units.command, "greatest command", kNotNegative);
  gains.cmd_min =
      params.number("cmd_min", fallback.cmd_min, units.command, "least command", kNotPositive);
  return gains;
}

Controller read_controller(Params& params) {
  const std::string name = params.choice(
      "controller", "profile", {"profile", "pid"},
      "profile: a setpoint led along a profile; pid: P + I + D of the distance to the target");
  return name == "pid" ? Controller::kPid : Controller::kProfile;
}

}  // namespace angen::devices
