#include "sim/command_queue.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <limits>

#include "core/alike.h"
#include "core/nearest.h"
#include "core/text.h"
#include "sim/guard.h"
#include "sim/view.h"

namespace angen::sim {

namespace {

constexpr std::size_t kMaxReason = 800;  // bytes

Event world_event(Nanoseconds time, const std::string& source, const std::string& event,
                  const std::string& detail = "") {
  return {time, source, "world", event, detail};
}

// "door/kitchen0" names kind and device where a bare name would be ambiguous.
ToDevice with_kind(const ToDevice& action) {
  const std::size_t slash = action.name.find('/');
  if (!action.kind.empty() || slash == std::string::npos) return action;
  return {action.name.substr(0, slash), action.name.substr(slash + 1), action.command};
}

Outcome unknown_device(const Building& building, const ToDevice& action) {
  const bool any = action.kind.empty();
  const std::vector<std::string> names = building.device_names(action.kind);
  const std::string kind = printable(action.kind);
  std::string message = "no " + (any ? "device" : kind) + " named '" + printable(action.name) +
                        "'; " + did_you_mean(action.name, names);
  if (names.size() > 3) message += " `angen list" + (any ? "" : " --kind " + kind) + "` lists all";
  return {false, message};
}

/// Why the device does not take the parsed command, "" where `act` will execute it.
std::string prepare(const Building::Target& target, const Command& command, Building& building,
                    Clock clock, std::function<void()>& act) {
  DeviceInstance& device = *target.device;
  if (!device.error.empty()) return "its plug-in has failed: " + device.error;
  Verdict verdict;
  const std::string thrown = thrown_by([&] {
    device.catch_up(clock.time, clock.step);
    device.idle_until = 0;
    verdict = device.device->command(command, InstanceView(building, *target.live, clock));
  });
  act = std::move(verdict.act);
  return verdict.accepted ? thrown : verdict.reason;
}

}  // namespace

Outcome to_device(const ToDevice& given, Building& building, Clock clock) {
  ToDevice action = with_kind(given);
  if (action.kind == "fault") {
    building.faults().give(action.name, action.command.text, clock.time);
    return {true, ""};
  }
  if (action.name.empty() && !action.kind.empty()) {  // the only one of a kind needs no name
    const std::vector<std::string> names = building.device_names(action.kind);
    if (names.empty()) return {false, "there is no " + printable(action.kind)};
    if (names.size() > 1) return {false, "no name; names are " + join_names(names)};
    action.name = names.front();
  }
  const std::vector<Building::Target> targets = building.devices_named(action.kind, action.name);
  if (targets.empty()) return unknown_device(building, action);
  if (targets.size() > 1 && action.name != "all") {
    const std::string& kind = targets[0].device->kind;
    return {false, "'" + action.name + "' is the name of a " + kind + " and a " +
                       targets[1].device->kind + "; write " + kind + "/" + action.name};
  }
  std::vector<std::function<void()>> acts(targets.size());
  Command command;
  const Plugin* parsed_for = nullptr;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Plugin* plugin = targets[i].device->plugin.get();
    std::string reason;
    if (std::exchange(parsed_for, plugin) != plugin) {
      command = action.command;
      reason = printable(parse_command(plugin->kind(), command), kMaxReason);
    }
    if (reason.empty()) reason = prepare(targets[i], command, building, clock, acts[i]);
    if (reason.empty()) continue;
    const char* others = targets.size() > 1 ? "; none of the others was commanded" : "";
    return {false, targets[i].device->name + ": " + reason + others};
  }
  for (const std::function<void()>& act : acts) {
    if (act) act();
  }
  return {true, ""};
}

namespace {

struct TextBytes {
  std::size_t operator()(const ToDevice& action) const {
    return action.kind.size() + action.name.size() + action.command.text.size() +
           action.command.values.size() * sizeof(double);
  }
  std::size_t operator()(const Reject& action) const {
    return action.source.size() + action.kind.size() + action.reason.size();
  }
  std::size_t operator()(const Note& action) const {
    return action.source.size() + action.kind.size() + action.event.size() + action.detail.size();
  }
  template <class Other>
  std::size_t operator()(const Other&) const {
    return 0;  // their senders wait, so there are few
  }
};

std::size_t bytes_of(const Action& action) {
  return sizeof(Request) + std::visit(TextBytes{}, action);
}

void cut(Event& event) {
  for (std::string* text : {&event.source, &event.kind, &event.event}) {
    *text = shortened(*text, CommandQueue::kMaxNameBytes);
  }
  event.detail = shortened(event.detail, CommandQueue::kMaxDetailBytes);
}

std::string progress(std::int64_t taken, std::int64_t ticks) {
  return " after " + std::to_string(taken) + " of " + std::to_string(ticks) + " ticks";
}

}  // namespace

CommandQueue::~CommandQueue() {
  for (Request& request : inbox_) request.answer.set_value({false, "the simulator ended"});
  for (Pending& step : steps_) step.answer.set_value({false, "the simulator ended"});
}

std::future<Outcome> CommandQueue::post(Action action, std::shared_ptr<Ticket> ticket) {
  const std::size_t bytes = bytes_of(action);
  Request request{std::move(action), {}, std::move(ticket)};
  std::future<Outcome> future = request.answer.get_future();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (waiting_ + bytes > kMaxQueuedBytes) {
    ++rejected_;
    request.answer.set_value({false, "too many commands wait; try again"});
    return future;
  }
  waiting_ += bytes;
  inbox_.push_back(std::move(request));
  return future;
}

std::vector<Request> CommandQueue::take() {
  std::vector<Request> requests;
  std::size_t rejected = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    requests.swap(inbox_);
    waiting_ = 0;
    rejected = std::exchange(rejected_, 0);
  }
  if (rejected > 0) {
    Request event;
    event.action = Reject{"world", "world",
                          std::to_string(rejected) + " commands were rejected: more than " +
                              std::to_string(kMaxQueuedBytes >> 20U) + " MB of them waited"};
    requests.push_back(std::move(event));
  }
  return requests;
}

CommandQueue::Effects CommandQueue::drain(Building& building, Clock clock,
                                          std::vector<Event>& events) {
  Effects effects;
  stop_withdrawn_steps(clock.time);
  const std::size_t before = events.size();
  Clock now = clock;
  std::vector<Request> requests = take();
  if (!replay_reason_.empty()) requests = only_replayed(std::move(requests));
  for (Request& request : requests) {
    if (request.ticket && !request.ticket->begin()) {
      answers_.emplace_back(std::move(request.answer), Outcome{false, "withdrawn"});
      continue;
    }
    if (observer_) observer_(request.action, clock.time);
    if (const Step* step = std::get_if<Step>(&request.action)) {
      begin_step(step->ticks, request);
      continue;
    }
    if (const auto* ended = std::get_if<StopStep>(&request.action)) {
      stop_step(ended->which);
      answers_.emplace_back(std::move(request.answer), Outcome{});
      continue;
    }
    Outcome outcome = execute(request.action, building, now, events, effects);
    if (effects.reset_time) now.time = 0;  // for the actions after the reset
    outcome.message = shortened(outcome.message, kMaxDetailBytes);
    answers_.emplace_back(std::move(request.answer), std::move(outcome));
  }
  for (std::size_t i = before; i < events.size(); ++i) cut(events[i]);
  return effects;
}

void CommandQueue::end_replay() {
  const std::string reason = std::exchange(replay_reason_, "");
  const std::size_t count = std::exchange(replay_rejected_, 0);
  if (count == 0) return;
  post(Reject{"world", "world",
              std::to_string(count) + (count == 1 ? " command was" : " commands were") +
                  " rejected: " + reason});
}

std::vector<Request> CommandQueue::only_replayed(std::vector<Request> requests) {
  std::vector<Request> kept;
  for (Request& request : requests) {
    if (only_reads(request.action)) {
      kept.push_back(std::move(request));
    } else {
      if (!request.ticket && !std::holds_alternative<Note>(request.action)) ++replay_rejected_;
      answers_.emplace_back(std::move(request.answer), Outcome{false, replay_reason_});
    }
  }
  for (Action& action : std::exchange(replayed_, {}))
    kept.push_back({std::move(action), {}, nullptr});
  return kept;
}

void CommandQueue::begin_step(std::uint64_t ticks, Request& request) {
  if (ticks == 0) {
    answers_.emplace_back(std::move(request.answer), Outcome{true, "no ticks"});
    return;
  }
  const auto count = static_cast<std::int64_t>(
      std::min<std::uint64_t>(ticks, std::numeric_limits<std::int64_t>::max()));
  steps_.push_back({count, count, std::move(request.answer), std::move(request.ticket)});
}

void CommandQueue::stop(Pending& step, const std::string& why) {
  const std::int64_t taken = step.ticks - step.left;
  answers_.emplace_back(std::move(step.answer), Outcome{false, why + progress(taken, step.ticks),
                                                        static_cast<std::uint64_t>(taken)});
}

void CommandQueue::stop_withdrawn_steps(Nanoseconds time) {
  for (std::size_t i = 0; i < steps_.size();) {
    if (!steps_[i].ticket || !steps_[i].ticket->withdrawn()) {
      ++i;
      continue;
    }
    if (observer_) observer_(StopStep{i}, time);
    stop_step(i);
  }
}

void CommandQueue::stop_step(std::uint64_t which) {
  if (which >= steps_.size()) return;
  stop(steps_[which], "stopped");
  steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(which));
}

void CommandQueue::interrupt_steps(const std::string& what) {
  for (Pending& step : steps_) stop(step, "interrupted by " + what);
  steps_.clear();
}

std::int64_t CommandQueue::ticks_to_go() const {
  return steps_.empty() ? INT64_MAX : steps_.front().left;
}

void CommandQueue::ticks_done(std::int64_t count) {
  if (steps_.empty() || (steps_.front().left -= count) > 0) return;
  const auto taken = static_cast<std::uint64_t>(steps_.front().ticks);
  answers_.emplace_back(std::move(steps_.front().answer), Outcome{true, "", taken});
  steps_.pop_front();
}

void CommandQueue::answer() {
  for (auto& [promise, outcome] : answers_) promise.set_value(std::move(outcome));
  answers_.clear();
}

Outcome CommandQueue::execute(const Action& action, Building& building, Clock clock,
                              std::vector<Event>& events, Effects& effects) {
  Outcome outcome;
  const auto rejected = [&](const std::string& why) {
    outcome = {false, why};
    events.push_back(world_event(clock.time, "world", "rejected", why));
  };
  try {
    if (const auto* command = std::get_if<ToDevice>(&action)) {
      effects.commanded = true;
      outcome = to_device(*command, building, clock);
      if (!outcome.ok) {
        events.push_back({clock.time, command->name, command->kind, "rejected", outcome.message});
      }
    } else if (const auto* spawn = std::get_if<Spawn>(&action)) {
      const std::size_t before = building.warnings().size();
      building.add(spawn->model, clock.time);
      events.push_back(world_event(clock.time, spawn->model.name, "spawned"));
      outcome.message = "spawned " + spawn->model.name;
      const std::vector<std::string>& all = building.warnings();
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(before);
      for (const std::string& warning : merge_alike(std::vector<std::string>(first, all.end()))) {
        outcome.message += "\nwarning: " + warning;
      }
    } else if (const auto* attach = std::get_if<Attach>(&action)) {
      building.attach(attach->sensor, attach->link, clock.time);
      events.push_back(
          world_event(clock.time, attach->sensor.name, "spawned", "on " + attach->link));
      outcome.message = "attached " + attach->sensor.name + " to " + attach->link;
    } else if (const auto* del = std::get_if<Delete>(&action)) {
      building.erase(del->name);
      events.push_back(world_event(clock.time, del->name, "deleted"));
      outcome.message = "deleted " + del->name;
    } else if (const auto* pause = std::get_if<Pause>(&action)) {
      interrupt_steps(pause->paused ? "a pause" : "the end of the pause");
      paused_ = pause->paused;
      events.push_back(world_event(clock.time, "world", paused_ ? "paused" : "unpaused"));
    } else if (const auto* reset = std::get_if<Reset>(&action)) {
      interrupt_steps("a reset");
      effects.reset = true;
      effects.reset_time = effects.reset_time || reset->with_time;
      building.reset(reset->with_time ? 0 : clock.time);
      events.push_back(world_event(clock.time, "world", "reset"));
    } else if (const auto* save = std::get_if<Save>(&action)) {
      effects.saves.push_back(save->into);
    } else if (const auto* edit = std::get_if<Edit>(&action)) {
      effects.commanded = true;  // devices may see it
      apply(*edit, building, clock.time);
    } else if (const auto* observation = std::get_if<Observe>(&action)) {
      *observation->into = sim::observe(building, observation->what);
      observation->into->time = clock.time;
    } else if (const auto* reject = std::get_if<Reject>(&action)) {
      outcome = {false, reject->reason};
      events.push_back({clock.time, reject->source, reject->kind, "rejected", reject->reason});
    } else if (const auto* note = std::get_if<Note>(&action)) {
      events.push_back({clock.time, note->source, note->kind, note->event, note->detail});
    }
  } catch (const std::exception& problem) {  // also of a plug-in, or of the standard library
    rejected(problem.what());
  } catch (...) {
    rejected("an exception that is not a std::exception");
  }
  return outcome;
}

}  // namespace angen::sim
