#pragma once

#include "plugin/plugin.h"

namespace angen::sensors {

/// What is read while nothing changes but the noise of the look itself. A sensor keeps one, tells
/// its readings by it, and gives a copy as its echo.
class OneDraw : public Echo {
 public:
  virtual void tell(Rng rng, Reading& reading) const = 0;
  void read(Nanoseconds, const Draws& draws, Reading& reading) const final {
    tell(draws(0), reading);
  }
};

}  // namespace angen::sensors
