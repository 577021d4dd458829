#pragma once

#include "core/time.h"

namespace angen {

/// States of devices that had no event are published at its multiples.
constexpr Nanoseconds kReportPeriod = kSecond / 50;

}  // namespace angen
