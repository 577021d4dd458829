#pragma once

#include <memory>
#include <vector>

#include "core/stopwatch.h"
#include "sim/snapshot.h"

namespace angen::sim {

/// Cost of ticks: CPU time of the thread that took them, ns.
struct Cost {
  Nanoseconds simulated = 0;  // by these ticks
  std::shared_ptr<const Structure> structure;
  std::vector<Nanoseconds> each_device;  // indexed like Structure::devices
  std::vector<Nanoseconds> each_sensor;  // indexed like Structure::sensors
  Nanoseconds commands = 0;              // executing commands
  Nanoseconds devices = 0;               // all of them, and finding those that have to act
  Nanoseconds physics = 0;               // and updating the other engines
  Nanoseconds sensors = 0;               // all of them, and finding those that are due
  Nanoseconds snapshots = 0;             // putting them together
};

/// Measures while it is on: each part of a tick ends with a lap, charged to who caused it. What
/// instances cost is in them; here is the rest.
struct Meter {
  bool on = false;
  Stopwatch watch;
  Cost rest;
};

}  // namespace angen::sim
