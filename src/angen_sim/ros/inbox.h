#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <utility>

#include "sim/simulation.h"

namespace angen::node {

/// The way from ROS's threads to the one that owns the world, and back.
class Inbox {
 public:
  static constexpr std::chrono::milliseconds kTimeout{10'000};

  explicit Inbox(sim::Simulation& simulation, std::chrono::milliseconds timeout = kTimeout)
      : simulation_(simulation), timeout_(timeout) {}

  /// Queues an action without waiting. A rejection is published on /angen/events and logged.
  void post(sim::Action action);

  /// Queues an event that a program adds to the log; lockstep does not count it as a command.
  void note(sim::Note note) { queue(std::move(note)); }

  /// Queues an action and waits for its outcome; of one that changes something, until the topics
  /// show it too. Gives up when simulated time has not advanced for `timeout` of wall time, when
  /// `is_lost` says that the caller has disconnected, or when the node ends. An action that is
  /// given up is withdrawn; one that has begun takes effect all the same, and the outcome says so.
  sim::Outcome call(sim::Action action, const std::function<bool()>& is_lost = {});

  /// The number of actions that post() has queued.
  std::uint64_t posted() const { return posted_; }

  /// Main thread: everything that the last tick changed has been published.
  void published();
  /// Main thread: sleeps until an action comes or `limit` is over; whether one has come.
  bool wait(std::chrono::nanoseconds limit);
  void close();

  sim::Simulation& simulation() { return simulation_; }

 private:
  void queue(sim::Action action);
  sim::Outcome give_up(sim::Ticket& ticket, bool is_step) const;

  sim::Simulation& simulation_;
  std::chrono::milliseconds timeout_;
  std::mutex mutex_;
  std::condition_variable wake_;  // wakes the main thread
  std::condition_variable done_;  // wakes callers that wait for a pass
  bool waiting_ = false;          // an action was queued since the last wait
  std::uint64_t passes_ = 0;
  std::atomic<std::uint64_t> posted_{0};
  std::atomic<bool> closed_{false};
};

}  // namespace angen::node
