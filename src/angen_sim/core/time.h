#pragma once

#include <cmath>
#include <cstdint>

namespace angen {

/// Simulated time and durations, integer nanoseconds. Never a running sum of doubles.
using Nanoseconds = std::int64_t;

constexpr Nanoseconds kSecond = 1'000'000'000;

inline double to_seconds(Nanoseconds t) { return static_cast<double>(t) * 1e-9; }
inline Nanoseconds from_seconds(double s) {
  return static_cast<Nanoseconds>(std::llround(s * 1e9));
}

}  // namespace angen
