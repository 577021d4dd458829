#pragma once

#include "core/time.h"

namespace angen::sim {

struct Clock {
  Nanoseconds time = 0;
  Nanoseconds step = 0;
};

}  // namespace angen::sim
