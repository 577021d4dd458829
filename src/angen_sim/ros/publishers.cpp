#include "ros/publishers.h"

#include <ros/console.h>
#include <ros/exceptions.h>

#include <algorithm>

#include "ros/topics.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

constexpr std::uint32_t kStateQueue = 100;  // a second of all that a moving door says
constexpr std::uint32_t kReadingQueue = 20;
constexpr Nanoseconds kOdometryPeriod = kSecond / 10;  // of a robot that stands still

}  // namespace

Outlet::Outlet(ros::NodeHandle& node, const Format& format, const std::string& topic, bool latch,
               std::uint32_t queue) {
  ros::AdvertiseOptions options = format.advertise(topic, queue, on_join(), on_leave());
  options.latch = latch;
  publisher_ = node.advertise(options);
}

ros::SubscriberStatusCallback Outlet::on_join() const {
  return [listeners = listeners_](const ros::SingleSubscriberPublisher&) {
    ++listeners->count;
    ++listeners->joined;
  };
}

ros::SubscriberStatusCallback Outlet::on_leave() const {
  return [listeners = listeners_](const ros::SingleSubscriberPublisher&) { --listeners->count; };
}

void Publishers::attach(Source& source, const Format& format, const std::string& topic, bool latch,
                        Channels& kept) {
  const Key key{topic, format.type};
  std::shared_ptr<Channel> channel;
  if (const auto old = channels_.find(key); old != channels_.end()) channel = old->second;
  if (const auto twin = kept.find(key); twin != kept.end()) channel = twin->second;
  if (channel == nullptr) {
    try {
      const std::uint32_t queue = latch ? kStateQueue : kReadingQueue;
      channel = std::make_shared<Channel>(
          Channel{Outlet(node_, format, topic, latch, queue), nullptr, &format});
    } catch (const ros::Exception& error) {
      ROS_WARN("%s is not published: %s", source.label.name.c_str(), error.what());
      return;
    }
  }
  kept[key] = channel;
  if (channel->outlet.works()) source.channels.push_back(std::move(channel));
}

void Publishers::follow(const sim::Snapshot& snapshot, const FrameTree& frames,
                        const std::vector<Robot>& robots) {
  const sim::Structure& structure = *snapshot.structure;
  Channels kept;
  std::vector<Source> sensors;
  for (std::size_t i = 0; i < structure.sensors.size(); ++i) {
    const sim::SensorEntry& entry = structure.sensors[i];
    Source source{{entry.name, frames.sensors[i]}, {}};
    for (const Format& format : formats_of(entry.kind)) {
      for (const std::string& topic : sensor_topics(entry, format, robot_in(robots, entry.model))) {
        attach(source, format, topic, false, kept);
      }
    }
    sensors.push_back(std::move(source));
  }
  std::vector<Source> devices;
  for (const sim::DeviceEntry& entry : structure.devices) {
    Source source{{entry.name, "world"}, {}};
    const Format& format = format_of(entry.kind);
    if (entry.kind != "drive") attach(source, format, topic_of(entry.kind, entry.name), true, kept);
    devices.push_back(std::move(source));
  }
  robots_.clear();
  for (const Robot& robot : robots) {
    Source& source = devices[robot.device];
    source.label = {robot.base_frame, robot.odom_frame};
    for (const std::string& topic : robot.odometry_topics) {
      attach(source, format_of("drive"), topic, false, kept);
    }
    robots_.push_back(robot.device);
  }
  channels_ = std::move(kept);  // what is not kept is shut down here
  sensors_ = std::move(sensors);
  devices_ = std::move(devices);
  costly_.clear();
  for (std::uint32_t i = 0; i < structure.sensors.size(); ++i) {
    const sim::SensorEntry& entry = structure.sensors[i];
    if (!entry.on_demand) continue;
    costly_.push_back({i, simulation_.wanted(entry.kind, entry.name)});
  }
  for (std::uint32_t i = 0; i < devices_.size(); ++i) send_state(snapshot, i);
}

// A sensor that looks on demand looks while anybody listens.
void Publishers::ask_for(const sim::Structure& structure) {
  for (Costly& costly : costly_) {
    const std::vector<std::shared_ptr<Channel>>& channels = sensors_[costly.sensor].channels;
    const bool wanted = std::any_of(channels.begin(), channels.end(),
                                    [](const auto& channel) { return channel->outlet.heard(); });
    if (wanted == costly.wanted) continue;
    costly.wanted = wanted;
    const sim::SensorEntry& entry = structure.sensors[costly.sensor];
    simulation_.want(entry.kind, entry.name, wanted);
  }
}

void Publishers::pass(const sim::Snapshot& snapshot) {
  ask_for(*snapshot.structure);
  for (const std::uint32_t i : snapshot.new_states) send_state(snapshot, i);
  for (const std::uint32_t i : snapshot.new_readings) {
    const Source& source = sensors_[i];
    for (const auto& channel : source.channels) {
      if (!channel->outlet.heard() || snapshot.sensors[i] == nullptr) continue;
      channel->format->publish(channel->outlet.publisher(), *snapshot.sensors[i], snapshot.stamp(i),
                               source.label);
    }
  }
  repeat_odometry(snapshot);
}

void Publishers::send_state(const sim::Snapshot& snapshot, std::uint32_t device) {
  const Source& source = devices_[device];
  const std::shared_ptr<const Reading>& state = snapshot.devices[device];
  for (const auto& channel : source.channels) {
    if (state == nullptr || channel->sent == state) continue;
    // A latched topic remembers its last message for those who come later.
    if (!channel->outlet.heard() && !channel->outlet.publisher().isLatched()) continue;
    channel->format->publish(channel->outlet.publisher(), *state, state->stamp, source.label);
    channel->sent = state;
  }
}

// Navigation takes an odometry that has stopped for one that has died.
void Publishers::repeat_odometry(const sim::Snapshot& snapshot) {
  const Nanoseconds slot = snapshot.time / kOdometryPeriod;
  if (slot == odometry_slot_) return;
  odometry_slot_ = slot;
  for (const std::uint32_t device : robots_) {
    const Source& source = devices_[device];
    const std::shared_ptr<const Reading>& state = snapshot.devices[device];
    if (state == nullptr || state->stamp == snapshot.time) continue;
    for (const auto& channel : source.channels) {
      if (channel->outlet.heard()) {
        channel->format->publish(channel->outlet.publisher(), *state, snapshot.time, source.label);
      }
    }
  }
}

}  // namespace angen::node
