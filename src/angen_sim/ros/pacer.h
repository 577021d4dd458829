#pragma once

#include <algorithm>
#include <chrono>
#include <string>

#include "core/text.h"
#include "core/time.h"

namespace angen::node {

constexpr std::chrono::seconds kWallSecond(1);

/// An error message for a rate with steps of that length; empty if it is valid. Calls wait for the
/// next tick.
inline std::string rate_problem(double rate, Nanoseconds step) {
  const double least = to_seconds(step);
  if (rate <= 0.0 || rate >= least) return "";
  return "a tick would take longer than a second, and calls wait for it; give at least " +
         number_text(least) + ", or 0 for no limit";
}

/// Keeps simulated time beside the wall's on an absolute schedule, so that no error adds up. What
/// the simulation cannot catch up within kMaxLag is given up.
class Pacer {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::nanoseconds kMaxLag = std::chrono::seconds(1);
  /// Ticks are taken this far ahead of the schedule, followed by one sleep: waking for
  /// each of them costs more than most of them do.
  static constexpr std::chrono::nanoseconds kBatch = std::chrono::milliseconds(10);

  /// Simulated seconds per wall second; 0 = no limit.
  explicit Pacer(double rate) : rate_(rate) {}

  double rate() const { return rate_; }
  void set_rate(double rate) {
    if (rate == rate_) return;
    rate_ = rate;
    restart();
  }

  /// Restarts the schedule: after a pause, a jump of time, or at the first tick.
  void restart() { anchored_ = false; }

  /// By how much `time` is ahead of the schedule; never negative, 0 at rate 0.
  std::chrono::nanoseconds ahead(Nanoseconds time, Clock::time_point now) {
    if (rate_ <= 0.0) return std::chrono::nanoseconds(0);
    if (!anchored_ || time < start_time_) anchor(time, now);
    const double due = static_cast<double>(time - start_time_) / rate_;
    const Clock::time_point when = start_ + std::chrono::nanoseconds(static_cast<Nanoseconds>(due));
    if (now - when > kMaxLag) anchor(time, now);
    return std::max<std::chrono::nanoseconds>(when - now, std::chrono::nanoseconds(0));
  }

 private:
  void anchor(Nanoseconds time, Clock::time_point now) {
    anchored_ = true;
    start_time_ = time;
    start_ = now;
  }

  double rate_;
  bool anchored_ = false;
  Nanoseconds start_time_ = 0;
  Clock::time_point start_;
};

}  // namespace angen::node
