#include "node/status_topics.h"

#include <angen_msgs/Event.h>
#include <angen_msgs/Summary.h>
#include <ros/console.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "core/home_fields.h"
#include "core/text.h"
#include "plugin/summary.h"
#include "ros/convert.h"

namespace angen::node {
namespace {

constexpr std::chrono::milliseconds kStill(100);

template <class Value>
void fill(const Value& value, Value& field) {
  field = value;
}

void fill(bool value, std::uint8_t& field) { field = value ? 1 : 0; }

void fill(const Pose& pose, geometry_msgs::Pose& field) { field = to_ros(pose); }

void fill(const FloorPose& pose, geometry_msgs::Pose& field) {
  field = to_ros(Pose{pose.position, from_rpy(0.0, 0.0, pose.yaw)});
}

void fill(const std::string (&names)[2], boost::array<std::string, 2>& field) {
  field = {names[0], names[1]};
}

void fill(const Polygon& polygon, geometry_msgs::Polygon& field) {
  for (const Point2& corner : polygon) {
    geometry_msgs::Point32& point = field.points.emplace_back();
    point.x = static_cast<float>(corner.x());
    point.y = static_cast<float>(corner.y());
  }
}

template <class Part, class Message>
auto fill(const Part& part, Message& message) -> decltype(visit_fields(part, 0));

template <class Each, class Message>
void fill(const std::vector<Each>& all, std::vector<Message>& field) {
  for (const Each& each : all) fill(each, field.emplace_back());
}

template <class Part, class Message>
auto fill(const Part& part, Message& message) -> decltype(visit_fields(part, 0)) {
  visit_fields(part, [&](const char*, const auto& value, const auto& of_message) {
    fill(value, of_message(message));
  });
}

void raise(geometry_msgs::Polygon& polygon, double z) {
  for (geometry_msgs::Point32& point : polygon.points) point.z = static_cast<float>(z);
}

angen_msgs::Home to_message(const Home& home) {
  angen_msgs::Home out;
  fill(home, out);
  for (angen_msgs::HomeRoom& room : out.rooms) {
    raise(room.polygon, room.floor);
    for (geometry_msgs::Polygon& hole : room.holes) raise(hole, room.floor);
  }
  return out;
}

constexpr std::chrono::milliseconds kSummaryPeriod(250);

angen_msgs::SummaryEntry entry_of(const Kind& kind, const std::string& name, const Reading* reading,
                                  Nanoseconds stamp) {
  angen_msgs::SummaryEntry entry;
  entry.kind = kind.name;
  entry.name = name;
  if (reading == nullptr) return entry;
  entry.text = summary(kind, *reading);
  entry.alarm = alarms(kind, *reading);
  entry.values = numbers(kind, *reading);
  entry.stamp = to_ros(stamp);
  return entry;
}

constexpr double kLow = 0.5;              // share of the requested rate
constexpr std::size_t kMaxFaulty = 1000;  // sensors

using Status = diagnostic_msgs::DiagnosticStatus;

void add(Status& status, const std::string& key, const std::string& value) {
  status.values.emplace_back();
  status.values.back().key = key;
  status.values.back().value = value;
}

Status status_of(const std::string& part, bool warns, const std::string& message) {
  Status status;
  status.name = "angen: " + part;
  status.hardware_id = "angen";
  status.level = warns ? Status::WARN : Status::OK;
  status.message = message;
  return status;
}

}  // namespace

ClockTopic::ClockTopic(ros::NodeHandle& node, double rate)
    : publisher_(LazyPublisher::of<rosgraph_msgs::Clock>(node, "clock", 100)),
      period_(std::max<Nanoseconds>(1, from_seconds(1.0 / rate))) {}

void ClockTopic::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  const Nanoseconds slot = snapshot.time / period_;
  if (slot == slot_ && now - sent_ < kStill) return;
  slot_ = slot;
  sent_ = now;
  ros::Time::setNow(to_ros(snapshot.time));  // stamps of this node's log
  publisher_.publish([&] {
    rosgraph_msgs::Clock message;
    message.clock = to_ros(snapshot.time);
    return message;
  });
}

Stats::Stats(ros::NodeHandle& node)
    : publisher_(LazyPublisher::of<angen_msgs::Stats>(node, "angen/stats", 10)) {}

void Stats::start() {
  if (publisher_.has_subscribers() != timing_) {
    timing_ = !timing_;
    ticks_.take();
  }
  watch_.start(timing_);
}

void Stats::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  if (timing_) ticks_.add(watch_.lap());
  const std::optional<double> factor = wall_.end(snapshot.time, now);
  if (!factor) return;
  publisher_.publish([&] { return message_of(snapshot, now, *factor); });
}

angen_msgs::Stats Stats::message_of(const sim::Snapshot& snapshot, Pacer::Clock::time_point now,
                                    double factor) {
  angen_msgs::Stats message;
  message.header.stamp = message.sim_time = to_ros(snapshot.time);
  message.real_time = ros::Duration(seconds(now - start_));
  message.real_time_factor = factor;
  message.step = to_seconds(snapshot.step);
  message.tick = static_cast<std::uint64_t>(snapshot.tick);
  message.paused = snapshot.paused;
  message.models = static_cast<std::uint32_t>(snapshot.structure->models.size());
  message.links = static_cast<std::uint32_t>(snapshot.structure->links.size());
  message.awake_bodies = snapshot.counts.awake_bodies;
  message.devices = static_cast<std::uint32_t>(snapshot.structure->devices.size());
  message.sensors = static_cast<std::uint32_t>(snapshot.structure->sensors.size());
  message.readings = snapshot.counts.readings;
  message.failed_steps = snapshot.counts.failed_steps;
  message.messages = Traffic::sent();
  const TickTimes::Summary ticks = ticks_.take();
  message.tick_median = to_seconds(ticks.median);
  message.tick_p99 = to_seconds(ticks.p99);
  message.tick_longest = to_seconds(ticks.longest);
  return message;
}

Events::Events(ros::NodeHandle& node)
    : publisher_(LazyPublisher::of<angen_msgs::Event>(node, "angen/events", 1000)) {}

void Events::publish(const sim::Snapshot& snapshot) {
  for (const sim::Event& event : snapshot.events) {
    if (event.event == "rejected" || event.event == "warning") {
      ROS_WARN("%s", printable(event.event + ": " + event.detail, 2000).c_str());
    }
    ++count_;
    publisher_.publish([&] {
      angen_msgs::Event message;
      message.header.stamp = to_ros(event.stamp);
      message.source = event.source;
      message.kind = event.kind;
      message.event = event.event;
      message.detail = event.detail;
      return message;
    });
  }
}

HomeTopic::HomeTopic(ros::NodeHandle& node) : publisher_(node, "angen/home", 1) {}

void HomeTopic::on_structure(const sim::Structure& structure) {
  if (structure.home == home_) return;
  home_ = structure.home;
  publisher_.set([home = home_] { return to_message(home->get()); });
}

SummaryTopic::SummaryTopic(ros::NodeHandle& node, Readings& readings)
    : readings_(readings),
      publisher_(LazyPublisher::of<angen_msgs::Summary>(node, "angen/summary", 10)) {}

void SummaryTopic::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  if (!publisher_.has_subscribers() || now < next_) return;
  next_ = now + kSummaryPeriod;
  const sim::Structure& structure = *snapshot.structure;
  const std::uint64_t subscriptions = publisher_.subscriptions();
  angen_msgs::Summary message;
  message.complete = subscriptions != subscriptions_ || snapshot.structure != structure_;
  subscriptions_ = subscriptions;
  structure_ = snapshot.structure;
  stamps_.resize(structure.sensors.size() + structure.devices.size());
  const auto changed = [&](std::size_t index, Nanoseconds stamp) {
    const bool is_new = stamps_[index] != stamp;
    stamps_[index] = stamp;
    return is_new || message.complete;
  };
  for (std::uint32_t i = 0; i < structure.sensors.size(); ++i) {
    const sim::SensorEntry& sensor = structure.sensors[i];
    const bool any = snapshot.sensors[i].reading != nullptr;
    const Nanoseconds stamp = any ? snapshot.stamp(i) : -1;
    if (!changed(i, stamp)) continue;
    message.entries.push_back(
        entry_of(sensor.plugin->kind(), sensor.name, readings_.of(snapshot, i).get(), stamp));
    if (!sensor.on_demand()) {
      message.entries.back().period = to_seconds(sensor.schedule.publish);
    }
  }
  for (std::size_t i = 0; i < structure.devices.size(); ++i) {
    const sim::DeviceEntry& device = structure.devices[i];
    const Reading* state = snapshot.devices[i].get();
    const Nanoseconds stamp = state != nullptr ? state->stamp : -1;
    if (!changed(structure.sensors.size() + i, stamp)) continue;
    message.entries.push_back(entry_of(device.plugin->kind(), device.name, state, stamp));
  }
  if (message.entries.empty() && !message.complete) return;
  message.header.stamp = to_ros(snapshot.time);
  publisher_.publish([&]() -> const angen_msgs::Summary& { return message; });
}

Diagnostics::Diagnostics(ros::NodeHandle& node)
    : publisher_(LazyPublisher::of<diagnostic_msgs::DiagnosticArray>(node, "diagnostics", 10)) {}

void Diagnostics::publish(const sim::Snapshot& snapshot, double rate,
                          Pacer::Clock::time_point now) {
  note_faults(snapshot);
  const std::optional<double> factor = wall_.end(snapshot.time, now);
  if (!factor) return;
  publisher_.publish([&] {
    diagnostic_msgs::DiagnosticArray message;
    message.header.stamp = to_ros(snapshot.time);
    message.status = {time_status(snapshot, rate, *factor), physics_status(snapshot),
                      sensor_status(snapshot)};
    return message;
  });
  failed_steps_ = snapshot.counts.failed_steps;
}

void Diagnostics::note_faults(const sim::Snapshot& snapshot) {
  for (const sim::Event& event : snapshot.events) {
    if (event.kind != "fault") continue;
    if (faults_.size() == kMaxFaulty && faults_.count(event.source) == 0) continue;
    faults_[event.source] = event.event + ", " + event.detail;
  }
}

Status Diagnostics::time_status(const sim::Snapshot& snapshot, double rate, double factor) const {
  const bool late = !snapshot.paused && rate > 0.0 && factor < kLow * rate;
  Status status = status_of("time", late,
                            late              ? "slower than half of the requested rate"
                            : snapshot.paused ? "paused"
                                              : "runs");
  add(status, "real-time factor", number_text(factor));
  add(status, "requested rate", rate > 0.0 ? number_text(rate) : "as fast as possible");
  add(status, "simulated time (s)", number_text(to_seconds(snapshot.time)));
  return status;
}

Status Diagnostics::physics_status(const sim::Snapshot& snapshot) const {
  const std::uint64_t failed = snapshot.counts.failed_steps - failed_steps_;
  Status status = status_of("physics", failed > 0,
                            failed > 0 ? "steps were redone by the iterative solver" : "exact");
  add(status, "redone steps", std::to_string(snapshot.counts.failed_steps));
  add(status, "awake bodies", std::to_string(snapshot.counts.awake_bodies));
  return status;
}

Status Diagnostics::sensor_status(const sim::Snapshot& snapshot) const {
  const auto& sensors = snapshot.structure->sensors;
  Status status = status_of("sensors", false, "no faults");
  add(status, "sensors", std::to_string(sensors.size()));
  std::size_t faulty = 0;
  for (const sim::SensorEntry& sensor : sensors) {
    const auto fault = faults_.find(sensor.name);
    if (fault == faults_.end()) continue;
    ++faulty;
    add(status, sensor.name, fault->second);
  }
  if (faulty == 0) return status;
  status.level = Status::WARN;
  status.message =
      std::to_string(faulty) + (faulty == 1 ? " sensor has" : " sensors have") + " had faults";
  return status;
}

}  // namespace angen::node
