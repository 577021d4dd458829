#pragma once

#include "plugin/view.h"

namespace angen::sensors {

struct AirHere {
  double temperature = 0.0;  // degrees Celsius
  double humidity = 0.0;     // percent
};

/// The air at the sensor: its room's, or outside of all rooms that outside. Not a number where the
/// world has no climate.
AirHere air_at(const View& view);

}  // namespace angen::sensors
