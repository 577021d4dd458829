#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "plugin/range.h"
#include "plugin/reading.h"

namespace angen {

/// Gaussian noise of one field of a reading: a number, or each of a list of numbers. Values that
/// are not finite (nothing in reach) have none, nor has 0 if the noise is relative.
struct Noise {
  std::string field;
  double mean = 0.0;
  double stddev = 0.0;
  Range range;            // a result is clamped to it, unless it is relative
  bool relative = false;  // mean and stddev are factors of the value, whose sign stays

  /// Whether a reading with these values differs from one sample to the next.
  bool varies(const Reading& reading) const;
  /// Adds it; each value takes the next gaussian() of `rng`.
  void apply(Rng& rng, Reading& reading) const;
};

/// Adds all of it to a copy of `clean`.
Reading with_noise(const std::vector<Noise>& noise, const Reading& clean, Rng rng);

}  // namespace angen
