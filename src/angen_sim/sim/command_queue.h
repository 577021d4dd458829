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

/// The one queue that everything from outside goes through, and the world's running state.
class CommandQueue {
 public:
  ~CommandQueue();

  std::future<Outcome> post(Action action);  // any thread
  void observe(ActionObserver observer) { observer_ = std::move(observer); }

  /// From now on only what replay() gives is carried out, and a Save; what others post is rejected
  /// with this reason. "" ends that.
  void take_over(std::string reason) { taken_over_ = std::move(reason); }
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
    std::int64_t left;
    std::promise<Outcome> answer;
  };

  Outcome execute(const Action& action, Building& building, InstanceView::Clock clock,
                  std::vector<Event>& events, Effects& effects);

  std::vector<Request> only_replayed(std::vector<Request> requests);

  mutable std::mutex mutex_;  // of inbox_ only
  std::vector<Request> inbox_;
  std::deque<Pending> steps_;
  std::vector<std::pair<std::promise<Outcome>, Outcome>> answers_;
  bool paused_ = false;
  ActionObserver observer_;
  std::string taken_over_;
  std::vector<Action> replayed_;
};

}  // namespace angen::sim
