#pragma once

#include <atomic>

namespace angen::sim {

/// Lets the sender of an action take it back until it has begun. Any thread may call anything.
class Ticket {
 public:
  /// True: the action will have no effect. False: it has begun; of a Step no more ticks are taken.
  bool withdraw() { return (state_.fetch_or(kWithdrawn) & kBegun) == 0; }
  bool withdrawn() const { return (state_ & kWithdrawn) != 0; }
  /// The queue's: false if the action was withdrawn.
  bool begin() { return (state_.fetch_or(kBegun) & kWithdrawn) == 0; }

 private:
  static constexpr unsigned kBegun = 1;
  static constexpr unsigned kWithdrawn = 2;

  std::atomic<unsigned> state_{0};
};

}  // namespace angen::sim
