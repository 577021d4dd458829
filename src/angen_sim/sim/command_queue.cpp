#include "sim/command_queue.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <limits>
#include <utility>

#include "core/nearest.h"
#include "sim/guard.h"

namespace angen::sim {

namespace {

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
  std::string message = "no " + (any ? "device" : action.kind) + " named '" + action.name + "'; " +
                        did_you_mean(action.name, names);
  if (names.size() > 3)
    message += " `angen list" + (any ? "" : " --kind " + action.kind) + "` lists all";
  return {false, message};
}

/// Why the device does not take the command, "" where `act` will carry it out.
std::string prepare(const Building::Target& target, Command command, Building& building,
                    InstanceView::Clock clock, std::function<void()>& act) {
  DeviceInstance& device = *target.device;
  if (!device.error.empty()) return "its plug-in has failed: " + device.error;
  const std::string wrong = parse_command(device.plugin->kind(), command);
  if (!wrong.empty()) return wrong;
  Verdict verdict;
  const std::string thrown = thrown_by([&] {
    device.catch_up(clock.time, clock.step);
    device.idle_until = 0;
    verdict = device.device->command(command, InstanceView(building, *target.live, clock));
  });
  act = std::move(verdict.act);
  return verdict.accepted ? thrown : verdict.reason;
}

Outcome to_device(const ToDevice& given, Building& building, InstanceView::Clock clock) {
  const ToDevice action = with_kind(given);
  const std::vector<Building::Target> targets = building.devices_named(action.kind, action.name);
  if (targets.empty()) return unknown_device(building, action);
  if (targets.size() > 1 && action.name != "all") {
    const std::string& kind = targets[0].device->kind;
    return {false, "'" + action.name + "' is the name of a " + kind + " and a " +
                       targets[1].device->kind + "; write " + kind + "/" + action.name};
  }
  std::vector<std::function<void()>> acts(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const std::string reason = prepare(targets[i], action.command, building, clock, acts[i]);
    if (reason.empty()) continue;
    const char* others = targets.size() > 1 ? "; none of the others was commanded" : "";
    return {false, targets[i].device->name + ": " + reason + others};
  }
  for (const std::function<void()>& act : acts) {
    if (act) act();
  }
  return {true, ""};
}

}  // namespace

CommandQueue::~CommandQueue() {
  for (Request& request : inbox_) request.answer.set_value({false, "the simulator ended"});
  for (Pending& step : steps_) step.answer.set_value({false, "the simulator ended"});
}

std::future<Outcome> CommandQueue::post(Action action) {
  Request request{std::move(action), {}};
  std::future<Outcome> future = request.answer.get_future();
  const std::lock_guard<std::mutex> lock(mutex_);
  inbox_.push_back(std::move(request));
  return future;
}

CommandQueue::Effects CommandQueue::drain(Building& building, InstanceView::Clock clock,
                                          std::vector<Event>& events) {
  std::vector<Request> requests;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    requests.swap(inbox_);
  }
  if (!taken_over_.empty()) requests = only_replayed(std::move(requests));
  Effects effects;
  for (Request& request : requests) {
    if (observer_) observer_(request.action, clock.time);
    if (const Step* step = std::get_if<Step>(&request.action)) {
      if (step->ticks == 0) {
        answers_.emplace_back(std::move(request.answer), Outcome{true, "no ticks"});
      } else {
        const auto ticks = static_cast<std::int64_t>(
            std::min<std::uint64_t>(step->ticks, std::numeric_limits<std::int64_t>::max()));
        steps_.push_back({ticks, std::move(request.answer)});
      }
      continue;
    }
    Outcome outcome = execute(request.action, building, clock, events, effects);
    answers_.emplace_back(std::move(request.answer), std::move(outcome));
  }
  return effects;
}

std::vector<Request> CommandQueue::only_replayed(std::vector<Request> requests) {
  std::vector<Request> kept;
  for (Request& request : requests) {
    if (std::holds_alternative<Save>(request.action)) {
      kept.push_back(std::move(request));
    } else {
      answers_.emplace_back(std::move(request.answer), Outcome{false, taken_over_});
    }
  }
  for (Action& action : std::exchange(replayed_, {})) kept.push_back({std::move(action), {}});
  return kept;
}

std::int64_t CommandQueue::ticks_to_go() const {
  return steps_.empty() ? INT64_MAX : steps_.front().left;
}

void CommandQueue::ticks_done(std::int64_t count) {
  if (steps_.empty() || (steps_.front().left -= count) > 0) return;
  answers_.emplace_back(std::move(steps_.front().answer), Outcome{});
  steps_.pop_front();
}

void CommandQueue::answer() {
  for (auto& [promise, outcome] : answers_) promise.set_value(std::move(outcome));
  answers_.clear();
}

Outcome CommandQueue::execute(const Action& action, Building& building, InstanceView::Clock clock,
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
      building.add(spawn->model, clock.time);
      events.push_back(world_event(clock.time, spawn->model.name, "spawned"));
      outcome.message = "spawned " + spawn->model.name;
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
      paused_ = pause->paused;
      events.push_back(world_event(clock.time, "world", paused_ ? "paused" : "unpaused"));
    } else if (const auto* reset = std::get_if<Reset>(&action)) {
      effects.reset = true;
      effects.reset_time = effects.reset_time || reset->with_time;
      building.reset(reset->with_time ? 0 : clock.time);
      events.push_back(world_event(clock.time, "world", "reset"));
    } else if (const auto* save = std::get_if<Save>(&action)) {
      effects.saves.push_back(save->into);
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
