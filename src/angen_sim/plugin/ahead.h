#pragma once

#include <cstdint>
#include <functional>

#include "core/random.h"
#include "core/time.h"
#include "plugin/reading.h"

namespace angen {

constexpr Nanoseconds kForever = INT64_MAX;

/// The random numbers of a sample, (0), and of those before it: (1) of the previous one.
using Draws = std::function<Rng(int samples_ago)>;

/// Makes readings that differ by time in a known way, or by noise that the sensor adds itself.
/// Snapshots hold it instead of readings that have not been read yet. Any thread may call it, also
/// after the sensor was deleted, so it depends on neither.
class LazyReading {
 public:
  virtual ~LazyReading() = default;
  /// Fills in the values of the sample at `time`, as the sensor's read() would.
  virtual void read(Nanoseconds time, const Draws& draws, Reading& reading) const = 0;
};

/// The samples that a sensor has yet to take, while all that they depend on stays as it is.
class Ahead {
 public:
  virtual ~Ahead() = default;
  /// The number of due times in a row at which all that it queries was unchanged.
  virtual int unchanged() const = 0;
  /// When the first one comes whose random numbers begin with a uniform() of `quiet` or more;
  /// kForever if that is 1.
  virtual Nanoseconds first_loud(double quiet) const = 0;
};

/// Noise so small that a sensor decides by it as without. The first uniform() of the random numbers
/// in a sample, as Rng::gaussians() draws them, shows it.
struct QuietNoise {
  double probability = 0.0;

  bool has(Rng sample) const { return sample.uniform() < probability; }
  /// For Sensor::idle_until(), of a sensor whose readings depend on `memory` samples before them.
  Nanoseconds until(const Ahead& ahead, int memory) const {
    return ahead.unchanged() > memory ? ahead.first_loud(probability) : 0;
  }
};

}  // namespace angen
