#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace angen::node {

/// Calls the ROS master, one call after the other, in a thread of its own. roscpp repeats a call
/// for as long as the master does not answer; the thread that steps the world never waits for it.
class Registrar {
 public:
  static Registrar& instance();

  ~Registrar();
  Registrar(const Registrar&) = delete;
  Registrar& operator=(const Registrar&) = delete;

  /// Queues a call, whose exceptions of roscpp are logged. Without ROS it is dropped. Any thread.
  void post(std::function<void()> call);
  /// Whether each queued call has returned.
  bool idle() const { return pending_ == 0; }

 private:
  Registrar();
  void run();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> calls_;
  std::atomic<std::size_t> pending_{0};
  bool ended_ = false;
  std::thread thread_;
};

/// A publisher or subscriber (or several) that the Registrar makes, and removes with the last copy.
template <class Handle>
class Registered {
 public:
  Registered() = default;
  /// `make` may throw exceptions of roscpp; `then` gets the handle once get() returns it.
  explicit Registered(std::function<Handle()> make, std::function<void(const Handle&)> then = {})
      : state_(std::make_shared<State>()) {
    Registrar::instance().post([state = state_, make = std::move(make), then = std::move(then)] {
      state->handle = make();
      state->is_made = true;
      if (then) then(state->handle);
    });
  }

  /// Null until the handle is made.
  const Handle* get() const {
    return state_ != nullptr && state_->is_made ? &state_->handle : nullptr;
  }

 private:
  struct State {
    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
      if (is_made) Registrar::instance().post([removed = std::move(handle)] {});
    }

    Handle handle;
    std::atomic<bool> is_made{false};
  };

  std::shared_ptr<State> state_;
};

}  // namespace angen::node
