#pragma once

#include <cstdint>
#include <deque>
#include <future>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "sim/building.h"
#include "sim/command.h"
#include "sim/view.h"

namespace angen::sim {

/// The one queue that everything from outside goes through, and the world's running state. What it
/// repeats of a text from outside, in events and answers, is cut to a length.
class CommandQueue {
 public:
  static constexpr std::size_t kMostWaiting = 16U << 20U;  // bytes of texts; more is refused
  static constexpr std::size_t kLongestName = 255;         // bytes in an event
  static constexpr std::size_t kLongestDetail = 2000;      // bytes in an event or an answer

  ~CommandQueue();

  /// Any thread. What is refused because too much waits is answered at once, and published as one
  /// event with the next tick.
  std::future<Outcome> post(Action action, std::shared_ptr<Ticket> ticket = nullptr);
  void observe(ActionObserver observer) { observer_ = std::move(observer); }

  /// From now on only what replay() gives is carried out, and a Save; what others post is rejected
  /// with this reason. "" ends that; what was rejected without a sender that waits is then counted
  /// in an event.
  void take_over(std::string reason);
  /// To be carried out by the next drain().
  void replay(std::vector<Action> actions) { replayed_ = std::move(actions); }

  struct Effects {
    bool reset = false;
    bool reset_time = false;
    bool commanded = false;                          // a device was
    std::vector<std::shared_ptr<SavedState>> saves;  // to be filled in
  };
  /// Carries out what waits, in order. Called between ticks.
  Effects drain(Building& building, InstanceView::Clock clock, std::vector<Event>& events);

  bool paused() const { return paused_; }
  bool running() const { return !paused_ || !steps_.empty(); }
  /// How many ticks may take place before a step is to be answered.
  std::int64_t ticks_to_go() const;
  /// Counts ticks that took place.
  void ticks_done(std::int64_t count);
  /// Answers what was carried out; called when the snapshot that shows it is out.
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
  Outcome execute(const Action& action, Building& building, InstanceView::Clock clock,
                  std::vector<Event>& events, Effects& effects);

  std::vector<Request> only_replayed(std::vector<Request> requests);

  mutable std::mutex mutex_;  // of the next three
  std::vector<Request> inbox_;
  std::size_t waiting_ = 0;  // bytes of texts in inbox_
  std::size_t refused_ = 0;  // actions since the last drain
  std::deque<Pending> steps_;
  std::vector<std::pair<std::promise<Outcome>, Outcome>> answers_;
  bool paused_ = false;
  ActionObserver observer_;
  std::string taken_over_;
  std::size_t turned_away_ = 0;  // actions without a sender that waits, while taken over
  std::vector<Action> replayed_;
};

}  // namespace angen::sim
