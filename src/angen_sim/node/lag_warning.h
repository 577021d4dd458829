#pragma once

#include <chrono>
#include <cmath>
#include <string>

#include "core/text.h"
#include "ros/pacer.h"

namespace angen::node {

/// A warning where simulated time lags far behind, at most once a minute.
class LagWarning {
 public:
  /// Call it after each tick. "" where there is nothing to say.
  std::string update(Nanoseconds time, double rate, bool paused, Pacer::Clock::time_point now) {
    if (paused || rate <= 0.0 || rate != rate_ || time < from_time_ || !begun_) {
      begin(time, rate, now);
      return "";
    }
    if (now - from_ < kWindow) return "";
    const double wall = std::chrono::duration<double>(now - from_).count();
    const double factor = to_seconds(time - from_time_) / wall;
    begin(time, rate, now);
    if (factor >= kFar * rate || now < silent_until_) return "";
    silent_until_ = now + kSilence;
    return "simulated time passes at " + rounded(factor) + " of real time, " + number_text(rate) +
           " was asked for; `angen top` shows what takes so long (bodies that overlap take most)";
  }

 private:
  static constexpr double kFar = 0.5;
  static constexpr std::chrono::seconds kWindow{10};
  static constexpr std::chrono::seconds kSilence{60};

  static std::string rounded(double factor) {
    return number_text(std::round(factor * 1000.0) / 1000.0);
  }

  void begin(Nanoseconds time, double rate, Pacer::Clock::time_point now) {
    begun_ = true;
    rate_ = rate;
    from_time_ = time;
    from_ = now;
  }

  bool begun_ = false;
  double rate_ = 0.0;
  Nanoseconds from_time_ = 0;
  Pacer::Clock::time_point from_{};
  Pacer::Clock::time_point silent_until_{};
};

}  // namespace angen::node
