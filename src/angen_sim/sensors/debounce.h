#pragma once

#include <optional>

#include "core/time.h"

namespace angen::sensors {

/// An output that follows an input which has lasted.
class Debounce {
 public:
  Nanoseconds duration = 0;  // least of a change that counts

  /// Whether the output changes now: the input has been `on` for long enough.
  bool changes(bool output, bool on, Nanoseconds now) {
    if (on == output) since_.reset();
    if (on == output) return false;
    if (!since_) since_ = now;
    if (now - *since_ < duration) return false;
    since_.reset();
    return true;
  }
  bool waits() const { return since_.has_value(); }

 private:
  std::optional<Nanoseconds> since_;  // the input has been otherwise
};

}  // namespace angen::sensors
