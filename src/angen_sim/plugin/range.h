#pragma once

#include <limits>

namespace angen {

/// Numbers from min to max, both included.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();

  bool contains(double value) const { return value >= min && value <= max; }
};
constexpr Range kPositive{std::numeric_limits<double>::min(),
                          std::numeric_limits<double>::infinity()};
constexpr Range kNotNegative{0.0, std::numeric_limits<double>::infinity()};

}  // namespace angen
