#include "sim/orders.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace angen::sim {

namespace {

Event world_event(Nanoseconds time, const std::string& source, const std::string& event,
                  const std::string& detail = "") {
  return {time, source, "world", event, detail};
}

struct Target {
  LiveModel* live;
  DeviceInstance* device;
};

// "door/kitchen0" names kind and device where a bare name would be ambiguous.
ToDevice with_kind(const ToDevice& order) {
  const std::size_t slash = order.name.find('/');
  if (!order.kind.empty() || slash == std::string::npos) return order;
  return {order.name.substr(0, slash), order.name.substr(slash + 1), order.command};
}

std::vector<Target> find_targets(Building& building, const ToDevice& order) {
  std::vector<Target> targets;
  for (auto& live : building.models()) {
    for (DeviceInstance& device : live->devices) {
      if (!order.kind.empty() && device.kind != order.kind) continue;
      if (device.name == order.name || (order.name == "all" && !order.kind.empty())) {
        targets.push_back({live.get(), &device});
      }
    }
  }
  return targets;
}

std::string known_devices(Building& building, const std::string& kind) {
  std::vector<std::string> names;
  for (auto& live : building.models()) {
    for (DeviceInstance& device : live->devices) {
      if (kind.empty()) names.push_back(device.kind + "/" + device.name);
      if (device.kind == kind) names.push_back(device.name);
    }
  }
  return join_names(names);
}

Outcome to_device(const ToDevice& given, Building& building, InstanceView::Clock clock) {
  const ToDevice order = with_kind(given);
  const std::vector<Target> targets = find_targets(building, order);
  const std::string kind = order.kind.empty() ? "device" : order.kind;
  if (targets.empty()) {
    return {false, "no " + kind + " named '" + order.name + "'; known are " +
                       known_devices(building, order.kind)};
  }
  if (targets.size() > 1 && order.name != "all") {
    return {false, "'" + order.name + "' is the name of a " + targets[0].device->kind + " and a " +
                       targets[1].device->kind + "; write " + targets[0].device->kind + "/" +
                       order.name};
  }
  std::vector<Verdict> verdicts;
  for (const Target& target : targets) {
    const InstanceView view(building, *target.live, clock);
    target.device->catch_up(clock.time, clock.step);
    target.device->idle_until = 0;
    verdicts.push_back(target.device->device->command(order.command, view));
    if (verdicts.back().accepted) continue;
    const char* others = targets.size() > 1 ? "; none of the others was commanded" : "";
    return {false, target.device->name + ": " + verdicts.back().reason + others};
  }
  for (const Verdict& verdict : verdicts) {
    if (verdict.act) verdict.act();
  }
  return {true, ""};
}

Outcome refused(const Error& error) { return {false, error.what()}; }

}  // namespace

Orders::~Orders() {
  for (Request& request : inbox_) request.answer.set_value({false, "the simulator ended"});
  for (Pending& step : steps_) step.answer.set_value({false, "the simulator ended"});
}

std::future<Outcome> Orders::post(Action action) {
  Request request{std::move(action), {}};
  std::future<Outcome> future = request.answer.get_future();
  const std::lock_guard<std::mutex> lock(mutex_);
  inbox_.push_back(std::move(request));
  return future;
}

Orders::Effects Orders::obey(Building& building, InstanceView::Clock clock,
                             std::vector<Event>& events) {
  std::vector<Request> requests;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    requests.swap(inbox_);
  }
  Effects effects;
  for (Request& request : requests) {
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
    Outcome outcome = carry_out(request.action, building, clock, events, effects);
    answers_.emplace_back(std::move(request.answer), std::move(outcome));
  }
  return effects;
}

std::int64_t Orders::ticks_to_go() const {
  return steps_.empty() ? INT64_MAX : steps_.front().left;
}

void Orders::ticks_done(std::int64_t count) {
  if (steps_.empty() || (steps_.front().left -= count) > 0) return;
  answers_.emplace_back(std::move(steps_.front().answer), Outcome{});
  steps_.pop_front();
}

void Orders::answer() {
  for (auto& [promise, outcome] : answers_) promise.set_value(std::move(outcome));
  answers_.clear();
}

Outcome Orders::carry_out(const Action& action, Building& building, InstanceView::Clock clock,
                          std::vector<Event>& events, Effects& effects) {
  Outcome outcome;
  try {
    if (const auto* order = std::get_if<ToDevice>(&action)) {
      effects.commanded = true;
      outcome = to_device(*order, building, clock);
      if (!outcome.ok) {
        events.push_back({clock.time, order->name, order->kind, "rejected", outcome.message});
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
    }
  } catch (const Error& error) {
    outcome = refused(error);
    events.push_back(world_event(clock.time, "world", "rejected", outcome.message));
  }
  return outcome;
}

}  // namespace angen::sim
