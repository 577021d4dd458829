#include "sensors/pir/trigger.h"

namespace angen::sensors {

Trigger::Times read_times(Params& params, const Trigger::Times& fallback) {
  if (params.has("blocking_time")) {
    throw params.error("blocking_time", "<blocking_time> is called <lockout_time> now");
  }
  const auto time = [&](const char* key, Nanoseconds otherwise, const char* doc) {
    return from_seconds(params.number(key, to_seconds(otherwise), "s", doc, {0.0, 1e6}));
  };
  Trigger::Times times;
  times.hold = time("hold_time", fallback.hold,
                    "duration of motion after its last detection; pyroelectric: 1.25");
  times.lockout = time("lockout_time", fallback.lockout,
                       "time without detections after motion; pyroelectric: 2.5");
  times.warm_up = time("warm_up", fallback.warm_up,
                       "time without detections after the start; pyroelectric: 60");
  times.retrigger = params.flag("retrigger", fallback.retrigger,
                                "whether each detection prolongs motion by the hold time");
  return times;
}

}  // namespace angen::sensors
