#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/time.h"

namespace angen::node {

/// Durations of recent ticks: two quantiles, 4 % exact, and the longest.
class TickTimes {
 public:
  struct Summary {
    Nanoseconds median = 0;
    Nanoseconds p99 = 0;
    Nanoseconds longest = 0;
  };

  void add(Nanoseconds time) {
    ++counts_[bin(time)];
    ++count_;
    if (time > longest_) longest_ = time;
  }

  /// Quantiles of those added since the last call; all 0 without any.
  Summary take() {
    const Summary summary{at(0.5), at(0.99), longest_};
    *this = {};
    return summary;
  }

 private:
  static constexpr std::size_t kBins = 512;
  static constexpr double kBinsPerOctave = 16.0;

  static std::size_t bin(Nanoseconds time) {
    if (time < 1) return 0;
    const double octave = std::log2(static_cast<double>(time));
    return std::min(kBins - 1, static_cast<std::size_t>(kBinsPerOctave * octave));
  }
  Nanoseconds at(double share) const {
    std::uint64_t left = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
    for (std::size_t i = 0; i < kBins; ++i) {
      if (counts_[i] < left) {
        left -= counts_[i];
        continue;
      }
      const double middle = (static_cast<double>(i) + 0.5) / kBinsPerOctave;
      return std::min(longest_, static_cast<Nanoseconds>(std::exp2(middle)));
    }
    return longest_;
  }

  std::array<std::uint32_t, kBins> counts_{};
  std::uint64_t count_ = 0;
  Nanoseconds longest_ = 0;
};

}  // namespace angen::node
