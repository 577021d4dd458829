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
  /// Call it after each tick; `cpu` is the CPU time of the thread that ticks. "" where there is
  /// nothing to say.
  std::string update(Nanoseconds time, double rate, bool paused, Pacer::Clock::time_point now,
                     Nanoseconds (*cpu)()) {
    if (paused || rate <= 0.0) {
      begun_ = false;
      return "";
    }
    if (!begun_ || rate != rate_ || time < from_time_) {
      begin(time, rate, now, cpu());
      return "";
    }
    if (now - from_ < kWindow) return "";
    const double wall = std::chrono::duration<double>(now - from_).count();
    const double factor = to_seconds(time - from_time_) / wall;
    const Nanoseconds used = cpu();
    const double share = to_seconds(used - from_cpu_) / wall;
    begin(time, rate, now, used);
    if (factor >= kFar * rate || now < silent_until_) return "";
    silent_until_ = now + kSilence;
    return "simulated time passes at " + rounded(factor) + " of real time, " + number_text(rate) +
           " was requested; " + reason(share);
  }

 private:
  static constexpr double kFar = 0.5;
  static constexpr double kBusy =
      0.7;  // share of a processor: the thread waits for no other program
  static constexpr std::chrono::seconds kWindow{10};
  static constexpr std::chrono::seconds kSilence{60};

  static std::string rounded(double factor) {
    return number_text(std::round(factor * 1000.0) / 1000.0);
  }

  static std::string reason(double share) {
    if (share >= kBusy) return "`angen top` shows the CPU time of each sensor and device";
    return "the simulation got " + number_text(std::round(share * 100.0)) +
           " % of a processor: other programs, such as rviz, use the rest";
  }

  void begin(Nanoseconds time, double rate, Pacer::Clock::time_point now, Nanoseconds cpu) {
    begun_ = true;
    rate_ = rate;
    from_time_ = time;
    from_ = now;
    from_cpu_ = cpu;
  }

  bool begun_ = false;
  double rate_ = 0.0;
  Nanoseconds from_time_ = 0;
  Pacer::Clock::time_point from_{};
  Nanoseconds from_cpu_ = 0;
  Pacer::Clock::time_point silent_until_{};
};

}  // namespace angen::node
