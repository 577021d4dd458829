#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <variant>

#include "core/time.h"
#include "desc/world.h"
#include "plugin/plugin.h"
#include "sim/edit.h"
#include "sim/entities.h"
#include "sim/saved.h"

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

/// The result of a command.
struct Outcome {
  bool ok = true;
  std::string message;
  std::uint64_t ticks = 0;  // ticks of a Step
};

/// To the device `name` of `kind`; kind "" = whichever kind has the name alone; name "all" = each.
struct ToDevice {
  std::string kind;
  std::string name;
  Command command;
};
struct Spawn {
  desc::Model model;
};
/// Attaches a sensor to a link that exists, `model::link`.
struct Attach {
  desc::Sensor sensor;
  std::string link;
};
/// Removes a model, or an attached sensor, by name.
struct Delete {
  std::string name;
};
struct Pause {
  bool paused = true;
};
/// Runs ticks although paused; answered when they are done, or when a pause, its end or a
/// reset interrupts it.
struct Step {
  std::uint64_t ticks = 1;
};
/// Ends the `which`th of the steps that are not done, as when its caller does not wait for it any
/// more; of a replay.
struct StopStep {
  std::uint64_t which = 0;
};
/// Every model back to where it was when it was added; with_time: the clock to 0 as well.
struct Reset {
  bool with_time = true;
};
/// Text that could not become a command; only published as a rejected event.
struct Reject {
  std::string source;
  std::string kind;
  std::string reason;
};

/// An event that a program outside adds, at the time of its arrival.
struct Note {
  std::string source;
  std::string kind;
  std::string event;
  std::string detail;
};

/// Fills in the state for a world file, between two ticks.
struct Save {
  std::shared_ptr<SavedState> into;
};

/// Fills in the states of entities and joints, between two ticks.
struct Observe {
  Observation what;
  std::shared_ptr<Observed> into;
};

using Action = std::variant<ToDevice, Spawn, Attach, Delete, Pause, Step, StopStep, Reset, Reject,
                            Note, Save, Edit, Observe>;

/// Whether the action only reads, so that no log has it.
inline bool only_reads(const Action& action) {
  return std::holds_alternative<Save>(action) || std::holds_alternative<Observe>(action);
}

/// Gets each action before it is executed, in order, and the time of its execution; in the
/// thread that ticks.
using ActionObserver = std::function<void(const Action&, Nanoseconds)>;

struct Request {
  Action action;
  std::promise<Outcome> answer;
  std::shared_ptr<Ticket> ticket;  // null: it cannot be withdrawn
};

}  // namespace angen::sim
