#include "node/status_topics.h"

#include <angen_msgs/Event.h>
#include <ros/console.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <chrono>

#include "core/text.h"
#include "ros/convert.h"

namespace angen::node {
namespace {

constexpr std::chrono::milliseconds kStill(100);
constexpr std::chrono::seconds kStatsPeriod(1);

double seconds(Pacer::Clock::duration d) { return std::chrono::duration<double>(d).count(); }

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
  if (now - sent_ < kStatsPeriod) return;
  const double wall = seconds(now - sent_);
  const double simulated = to_seconds(snapshot.time - sent_time_);
  sent_ = now;
  sent_time_ = snapshot.time;
  publisher_.publish([&] { return message_of(snapshot, now, std::max(0.0, simulated / wall)); });
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

}  // namespace angen::node
