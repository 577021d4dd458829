#include "sim/faults.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/text.h"

namespace angen::sim {

namespace {

constexpr double kDay = 86400.0;
constexpr double kShortest = 1.25;  // s that a false alarm lasts
constexpr double kLongest = 6.0;
constexpr Nanoseconds kEcho = kSecond / 20;  // between a message and its duplicate

/// The flag that a false alarm of the sensor changes; null: it has none.
const Field* alarm_of(const SensorEntry& entry) {
  const std::vector<Field>& fields = entry.plugin->kind().fields;
  const auto at = std::find_if(fields.begin(), fields.end(),
                               [](const Field& field) { return !field.begin_event.empty(); });
  return at == fields.end() ? nullptr : &*at;
}

std::shared_ptr<const Reading> stamped(const Reading& reading, Nanoseconds stamp) {
  auto made = std::make_shared<Reading>(reading);
  made->stamp = stamp;
  return made;
}

std::string in_seconds(Nanoseconds time) {
  return number_text(std::round(static_cast<double>(time) / 1e6) / 1e3) + " s";
}

/// Names of its events; of one without, "reading" where that has news.
std::string events_text(const std::vector<Event>& events, bool is_news) {
  std::string names;
  for (const Event& event : events) names += (names.empty() ? "" : ", ") + event.event;
  return names.empty() && is_news ? "reading" : names;
}

}  // namespace

/// The number of faults that it takes: a sensor that raises no alarms has no false ones.
std::size_t Faults::add(const SensorEntry& entry, const std::vector<Fault>& faults,
                        Nanoseconds now) {
  std::size_t given = 0;
  const std::string key = full_name(entry);
  const bool alarms = alarm_of(entry) != nullptr;
  for (const Fault& fault : faults) {
    if (fault.kind == Fault::Kind::kFalseAlarm && !alarms) continue;
    Channel& channel = channels_[key];
    ++given;
    Active active;
    active.fault = fault;
    active.since = now;
    active.key = hash_bytes(key + "#fault" + std::to_string(channel.given++));
    if (fault.kind == Fault::Kind::kFalseAlarm) draw_alarm(active, now);
    channel.faults.push_back(active);
  }
  return given;
}

void Faults::follow(std::shared_ptr<const Structure> structure, Nanoseconds now) {
  structure_ = std::move(structure);
  std::set<std::string> here;
  for (std::size_t i = 0; i < structure_->sensors.size(); ++i) {
    const SensorEntry& entry = structure_->sensors[i];
    if (entry.faults.empty() && channels_.empty()) continue;
    const std::string key = full_name(entry);
    here.insert(key);
    if (!entry.faults.empty() && known_.insert(key).second) add(entry, entry.faults, now);
    const auto channel = channels_.find(key);
    if (channel != channels_.end()) channel->second.index = i;
  }
  const auto is_gone = [&](const std::string& key) { return here.count(key) == 0; };
  for (auto at = channels_.begin(); at != channels_.end();) {
    at = is_gone(at->first) ? channels_.erase(at) : std::next(at);
  }
  for (auto at = known_.begin(); at != known_.end();) {
    at = is_gone(*at) ? known_.erase(at) : std::next(at);
  }
}

void Faults::give(const std::string& pattern, const std::string& text, Nanoseconds now) {
  const bool off = trimmed(text) == "Off" || trimmed(text) == "off";
  const std::vector<Fault> faults = off ? std::vector<Fault>{} : parse_faults(text);
  if (!off && faults.empty()) throw Error("no fault; write one as dropout share=0.1, or Off");
  std::vector<const SensorEntry*> found;
  for (const SensorEntry& entry : structure_->sensors) {
    const std::string key = full_name(entry);
    if (fnmatch(pattern.c_str(), entry.name.c_str(), 0) == 0 ||
        fnmatch(pattern.c_str(), key.c_str(), 0) == 0) {
      found.push_back(&entry);
    }
  }
  if (found.empty()) {
    throw Error("no sensor is named '" + printable(pattern) + "'; `angen list` lists all");
  }
  std::size_t given = 0;
  for (const SensorEntry* entry : found) {
    if (off) {
      channels_.erase(full_name(*entry));
    } else {
      given += add(*entry, faults, now);
    }
  }
  if (off) return;
  if (given == 0) throw Error("'" + printable(pattern) + "' raises no alarms that could be false");
  follow(structure_, now);
}

void Faults::reset() {
  channels_.clear();
  known_.clear();
}

std::vector<Faults::Move> Faults::moves(Nanoseconds now) {
  std::vector<Move> found;
  for (auto& [key, channel] : channels_) {
    for (Active& active : channel.faults) {
      if (active.fault.kind != Fault::Kind::kMoved || active.done) continue;
      if (now < active.since + active.fault.from) continue;
      active.done = true;
      const std::size_t split = key.find('/');
      found.push_back({key.substr(0, split), key.substr(split + 1), active.fault.by});
      const Vec3& at = active.fault.by.position;
      note(channel, active, now,
           "by " + number_text(at.x()) + " " + number_text(at.y()) + " " + number_text(at.z()) +
               " m in its frame");
    }
  }
  return found;
}

Nanoseconds Faults::next() const {
  Nanoseconds first = kForever;
  for (const auto& [key, channel] : channels_) {
    for (const Active& active : channel.faults) {
      first = std::min(first, active.alarm_end > 0 ? active.alarm_end : active.alarm);
      if (active.fault.kind == Fault::Kind::kMoved && !active.done) {
        first = std::min(first, active.since + active.fault.from);
      }
    }
    for (const auto& [time, message] : channel.late) first = std::min(first, time);
  }
  return first;
}

void Faults::pass(Snapshot& made) {
  if (channels_.empty()) {
    made.events.insert(made.events.end(), notes_.begin(), notes_.end());
    notes_.clear();
    return;
  }
  std::map<std::string, std::vector<Event>> events;
  std::vector<Event> others;
  for (Event& event : made.events) {
    const std::string key = event.kind + "/" + event.source;
    const bool here = channels_.count(key) != 0;
    (here ? events[key] : others).push_back(std::move(event));
  }
  made.events = std::move(others);
  for (auto& [key, channel] : channels_) {
    Message message;
    const auto sent = std::lower_bound(made.new_readings.begin(), made.new_readings.end(),
                                       static_cast<std::uint32_t>(channel.index));
    message.sent = sent != made.new_readings.end() && *sent == channel.index;
    if (message.sent) made.new_readings.erase(sent);
    message.events = std::move(events[key]);
    if (made.sensors[channel.index].reading) {
      message.stamp = made.stamp(channel.index);
      if (message.stamp != channel.stamp || message.sent) {
        message.reading = stamped(*made.reading(channel.index), message.stamp);
        channel.clean = message.reading;
        channel.stamp = message.stamp;
      }
    }
    for (Message& arrived : messages(channel, std::move(message), made)) {
      deliver(channel, std::move(arrived), made);
    }
    made.sensors.set(channel.index, {channel.shown.reading, nullptr,
                                     channel.shown.reading ? channel.shown.stamp : -1});
  }
  made.events.insert(made.events.end(), notes_.begin(), notes_.end());
  notes_.clear();
}

/// The messages that arrive now.
std::vector<Faults::Message> Faults::messages(Channel& channel, Message message,
                                              const Snapshot& now) {
  std::vector<Message> found;
  const auto due = std::stable_partition(channel.late.begin(), channel.late.end(),
                                         [&](const auto& each) { return each.first > now.time; });
  std::stable_sort(due, channel.late.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto at = due; at != channel.late.end(); ++at) found.push_back(std::move(at->second));
  channel.late.erase(due, channel.late.end());
  if (message.reading || !message.events.empty()) {
    Nanoseconds delay = 0;
    bool twice = false;
    const bool comes = std::all_of(
        channel.faults.begin(), channel.faults.end(),
        [&](Active& active) { return passes(active, channel, message, now, delay, twice); });
    if (comes && twice) channel.late.emplace_back(now.time + delay + kEcho, message);
    if (comes && delay > 0) {
      for (Event& event : message.events) event.stamp += delay;
      channel.late.emplace_back(now.time + delay, std::move(message));
    } else if (comes) {
      found.push_back(std::move(message));
    }
  }
  for (Active& active : channel.faults) alarm(active, channel, now, found);
  return found;
}

/// Whether a message comes through one fault, which may change it.
bool Faults::passes(Active& active, Channel& channel, Message& message, const Snapshot& now,
                    Nanoseconds& delay, bool& twice) {
  const Fault& fault = active.fault;
  const Nanoseconds age = now.time - active.since - fault.from;
  const bool inside = age >= 0 && age < fault.lasts;
  Rng rng(seed_, active.key, now.tick);
  const bool flagged = alarm_of(structure_->sensors[channel.index]) != nullptr;
  const std::string what = events_text(message.events, message.sent && !flagged);
  const auto say = [&](const std::string& done) {
    if (!what.empty()) note(channel, active, now.time, what + " " + done);
  };
  switch (fault.kind) {
    case Fault::Kind::kDropout:
    case Fault::Kind::kBattery: {
      const double fades =
          age < 0 ? 0.0
                  : std::min(static_cast<double>(age) / static_cast<double>(fault.lasts), 1.0);
      const bool lost = rng.uniform() < (fault.kind == Fault::Kind::kDropout ? fault.share : fades);
      if (lost) say("lost");
      return !lost;
    }
    case Fault::Kind::kStuck: {
      if (!inside || !channel.shown.reading) return true;
      if (!std::exchange(active.begun, true)) note(channel, active, now.time, "begins");
      if (!message.events.empty()) say("lost");
      message.events.clear();
      if (message.reading) message.reading = stamped(*channel.shown.reading, message.stamp);
      return true;
    }
    case Fault::Kind::kDelay: {
      const auto more =
          static_cast<Nanoseconds>(static_cast<double>(fault.least) +
                                   rng.uniform() * static_cast<double>(fault.most - fault.least));
      delay += more;
      say("by " + in_seconds(more));
      return true;
    }
    case Fault::Kind::kDuplicate: {
      const bool again = rng.uniform() < fault.share;
      if (again) say("twice");
      twice = twice || again;
      return true;
    }
    case Fault::Kind::kClock: {
      const auto gained = static_cast<Nanoseconds>(
          std::llround(static_cast<double>(now.time - active.since) / kDay * fault.a_day));
      message.stamp = std::max<Nanoseconds>(message.stamp + gained, 0);
      if (message.reading) message.reading = stamped(*message.reading, message.stamp);
      for (Event& event : message.events) {
        event.stamp = std::max<Nanoseconds>(event.stamp + gained, 0);
      }
      say("by " + in_seconds(gained));
      return true;
    }
    case Fault::Kind::kFalseAlarm: {
      if (active.alarm_end == 0) return true;
      const Field& flag = *alarm_of(structure_->sensors[channel.index]);
      message.events.clear();
      if (message.reading) {
        auto forced = std::make_shared<Reading>(*message.reading);
        forced->set(flag.name.c_str(), flag.in_alarm);
        message.reading = forced;
      }
      return true;
    }
    case Fault::Kind::kMoved:
      return true;
  }
  return true;
}

/// When the next false alarm begins: those of a day are a Poisson process.
void Faults::draw_alarm(Active& active, Nanoseconds now) const {
  Rng rng(seed_, active.key, active.alarms);
  const double mean = active.fault.a_day > 0.0 ? kDay / active.fault.a_day : 1e9;
  const double after = -std::log1p(-rng.uniform()) * mean;
  active.alarm = now + static_cast<Nanoseconds>(std::min(after, 1e9) * kSecond);
}

void Faults::alarm(Active& active, Channel& channel, const Snapshot& now,
                   std::vector<Message>& found) {
  const SensorEntry& entry = structure_->sensors[channel.index];
  const Field* flag = alarm_of(entry);
  if (active.fault.kind != Fault::Kind::kFalseAlarm || flag == nullptr || !channel.clean) return;
  const bool is_on = channel.clean->get(flag->name, !flag->in_alarm) == flag->in_alarm;
  const auto tell = [&](const std::string& event, bool value) {
    auto reading = std::make_shared<Reading>(*channel.clean);
    reading->stamp = now.time;
    reading->set(flag->name.c_str(), value);
    reading->event = event;
    found.push_back(
        {reading, now.time, true, {{now.time, entry.name, entry.kind, event, "false alarm"}}});
  };
  if (active.alarm_end > 0 && now.time >= active.alarm_end) {
    active.alarm_end = 0;
    if (!is_on) tell(flag->end_event, !flag->in_alarm);
  }
  if (active.alarm_end > 0 || now.time < active.alarm) return;
  Rng rng(seed_, ~active.key, active.alarms++);
  const double lasts = kShortest + (kLongest - kShortest) * rng.uniform();
  draw_alarm(active, now.time);
  if (is_on) return;
  active.alarm_end = now.time + static_cast<Nanoseconds>(lasts * kSecond);
  active.alarm = std::max(active.alarm, active.alarm_end + kSecond);
  note(channel, active, now.time,
       flag->begin_event + " for " + in_seconds(active.alarm_end - now.time));
  tell(flag->begin_event, flag->in_alarm);
}

void Faults::deliver(Channel& channel, Message message, Snapshot& made) {
  made.events.insert(made.events.end(), message.events.begin(), message.events.end());
  if (!message.reading) return;
  if (message.sent) {
    const auto index = static_cast<std::uint32_t>(channel.index);
    const auto at = std::lower_bound(made.new_readings.begin(), made.new_readings.end(), index);
    if (at == made.new_readings.end() || *at != index) made.new_readings.insert(at, index);
  }
  channel.shown = std::move(message);
}

void Faults::note(const Channel& channel, const Active& active, Nanoseconds now,
                  const std::string& detail) {
  const SensorEntry& entry = structure_->sensors[channel.index];
  notes_.push_back({now, entry.name, "fault", active.fault.name(), entry.kind + ": " + detail});
}

}  // namespace angen::sim
