#include "node/summary_topic.h"

#include <angen_msgs/Summary.h>

#include <chrono>
#include <cstdint>
#include <vector>

#include "plugin/summary.h"
#include "ros/convert.h"

namespace angen::node {
namespace {

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

}  // namespace

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

}  // namespace angen::node
