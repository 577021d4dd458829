#pragma once

#include <cstdint>
#include <deque>
#include <future>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "sim/building.h"
#include "sim/clock.h"
#include "sim/command.h"

namespace angen::sim {

/// Executes a command, in no queue.
Outcome to_device(const ToDevice& given, Building& building, Clock clock);

/// The one queue of all actions from outside, and the world's running state. It cuts the texts from
/// outside that it repeats in events and answers.
class CommandQueue {
 public:
  static constexpr std::size_t kMaxQueuedBytes = 16U << 20U;  // bytes of texts; more is rejected
  static constexpr std::size_t kMaxNameBytes = 255;           // in an event
  static constexpr std::size_t kMaxDetailBytes = 2000;        // in an event or an answer

  ~CommandQueue();

  /// Any thread. An action that is rejected because too much waits is answered at once; the next
  /// tick publishes one event for all of these.
  std::future<Outcome> post(Action action, std::shared_ptr<Ticket> ticket = nullptr);
  void observe(ActionObserver observer) { observer_ = std::move(observer); }

  /// From now on only actions of replay() are executed, and a Save; actions that others post are
  /// rejected with this reason.
  void accept_only_replay(std::string reason) { replay_reason_ = std::move(reason); }
  /// An event counts the actions that were rejected and whose sender did not wait.
  void end_replay();
  /// To be executed by the next drain().
  void replay(std::vector<Action> actions) { replayed_ = std::move(actions); }

  struct Effects {
    bool reset = false;
    bool reset_time = false;
    bool commanded = false;                          // a device was
    std::vector<std::shared_ptr<SavedState>> saves;  // to be filled in
  };
  /// Executes the actions that wait, in order. Called between ticks.
  Effects drain(Building& building, Clock clock, std::vector<Event>& events);

  bool paused() const { return paused_; }
  bool running() const { return !paused_ || !steps_.empty(); }
  /// The number of ticks until the next step is to be answered.
  std::int64_t ticks_to_go() const;
  /// Counts ticks that took place.
  void ticks_done(std::int64_t count);
  /// Answers executed actions; called when the snapshot that shows them is out.
  void answer();

 private:
  struct Pending {
    std::int64_t ticks;
    std::int64_t left;
    std::promise<Outcome> answer;
    std::shared_ptr<Ticket> ticket;
  };

  std::vector<Request> take();
  void begin_step(std::uint64_t ticks, Request& request);
  void stop_withdrawn_steps(Nanoseconds time);
  void stop_step(std::uint64_t which);
  void interrupt_steps(const std::string& what);
  void stop(Pending& step, const std::string& why);
  Outcome execute(const Action& action, Building& building, Clock clock, std::vector<Event>& events,
                  Effects& effects);

  std::vector<Request> only_replayed(std::vector<Request> requests);

  mutable std::mutex mutex_;  // guards the next three
  std::vector<Request> inbox_;
  std::size_t waiting_ = 0;   // bytes of texts in inbox_
  std::size_t rejected_ = 0;  // actions since the last drain
  std::deque<Pending> steps_;
  std::vector<std::pair<std::promise<Outcome>, Outcome>> answers_;
  bool paused_ = false;
  ActionObserver observer_;
  std::string replay_reason_;        // why actions of others are rejected; empty: they are not
  std::size_t replay_rejected_ = 0;  // rejected ones whose sender did not wait
  std::vector<Action> replayed_;
};

}  // namespace angen::sim
