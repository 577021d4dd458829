#include "ros/inbox.h"

#include <memory>
#include <string>
#include <variant>

#include "core/text.h"

namespace angen::node {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kSlice(50);
constexpr std::chrono::seconds kPassTimeout(1);

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

sim::Outcome Inbox::give_up(sim::Ticket& ticket, bool is_step) const {
  const double seconds = std::chrono::duration<double>(timeout_).count();
  const std::string why = "the simulation did not answer within " + number_text(seconds) + " s; ";
  if (ticket.withdraw()) return {false, why + "nothing was done"};
  if (is_step) return {false, why + "the tick that it takes now is the last of this step"};
  return {false, why + "it has begun, and takes effect when it is done: see /angen/events"};
}

sim::Outcome Inbox::call(sim::Action action, const std::function<bool()>& is_lost) {
  const bool is_step = std::holds_alternative<sim::Step>(action);
  const bool changes = !sim::only_reads(action);
  const auto ticket = std::make_shared<sim::Ticket>();
  std::future<sim::Outcome> answer = simulation_.post(std::move(action), ticket);
  std::int64_t tick = simulation_.snapshot()->tick;
  Clock::time_point limit = Clock::now() + timeout_;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_ = true;
    wake_.notify_one();
  }
  while (answer.wait_for(kSlice) != std::future_status::ready) {
    if (closed_) return {false, "the simulator ends"};
    if (is_lost && is_lost()) ticket->withdraw();
    const std::int64_t now = simulation_.snapshot()->tick;
    if (now != tick) limit = Clock::now() + timeout_;
    tick = now;
    if (Clock::now() > limit) return give_up(*ticket, is_step);
  }
  sim::Outcome outcome = answer.get();
  if (!changes) return outcome;
  std::unique_lock<std::mutex> lock(mutex_);
  waiting_ = true;
  wake_.notify_one();
  const std::uint64_t passes = passes_;
  done_.wait_for(lock, kPassTimeout, [&] { return passes_ > passes || closed_; });
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
