#include "ros/inbox.h"

#include <utility>

namespace angen::node {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kSlice(50);
constexpr std::chrono::seconds kPassPatience(1);

}  // namespace

void Inbox::post(sim::Action action) {
  queue(std::move(action));
  ++posted_;
}

void Inbox::queue(sim::Action action) {
  simulation_.post(std::move(action));
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_ = true;
  wake_.notify_one();
}

sim::Outcome Inbox::call(sim::Action action) {
  std::future<sim::Outcome> answer = simulation_.post(std::move(action));
  std::int64_t tick = simulation_.snapshot()->tick;
  Clock::time_point limit = Clock::now() + kPatience;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_ = true;
    wake_.notify_one();
  }
  while (answer.wait_for(kSlice) != std::future_status::ready) {
    if (closed_) return {false, "the simulator ends"};
    const std::int64_t now = simulation_.snapshot()->tick;
    if (now != tick) limit = Clock::now() + kPatience;
    tick = now;
    if (Clock::now() > limit) return {false, "the simulation did not answer within 10 s"};
  }
  sim::Outcome outcome = answer.get();
  std::unique_lock<std::mutex> lock(mutex_);
  waiting_ = true;
  wake_.notify_one();
  const std::uint64_t passes = passes_;
  done_.wait_for(lock, kPassPatience, [&] { return passes_ > passes || closed_; });
  return outcome;
}

void Inbox::published() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++passes_;
  done_.notify_all();
}

bool Inbox::wait(std::chrono::nanoseconds limit) {
  std::unique_lock<std::mutex> lock(mutex_);
  wake_.wait_for(lock, limit, [this] { return waiting_ || closed_; });
  return std::exchange(waiting_, false);
}

void Inbox::close() {
  const std::lock_guard<std::mutex> lock(mutex_);
  closed_ = true;
  wake_.notify_all();
  done_.notify_all();
}

}  // namespace angen::node
