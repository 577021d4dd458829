#include "ros/publishers.h"

#include <ros/console.h>
#include <ros/exceptions.h>

#include <algorithm>

#include "ros/wire.h"

namespace angen::node {
namespace {

constexpr Nanoseconds kOdometryPeriod = kSecond / 10;  // of a robot that stands still

}  // namespace

void Publishers::attach(Source& source, const std::string& type, const Format::Open& open,
                        const std::string& topic, Channels& kept) {
  const Key key{topic, type};
  std::shared_ptr<Channel> channel;
  if (const auto old = channels_.find(key); old != channels_.end()) channel = old->second;
  if (const auto twin = kept.find(key); twin != kept.end()) channel = twin->second;
  if (channel == nullptr) {
    try {
      channel = open(node_, topic);
    } catch (const ros::Exception& error) {
      ROS_WARN("%s is not published: %s", source.label->name.c_str(), error.what());
      return;
    }
  }
  kept[key] = channel;
  source.channels.push_back(std::move(channel));
}

Publishers::Source Publishers::sensor_source(const sim::SensorEntry& entry,
                                             const std::string& frame, const Robot* robot,
                                             Channels& kept) {
  Source source{std::make_shared<const Label>(Label{entry.name, frame}), {}};
  for (const Format& format : ros_kind(entry.kind, entry.desc->plugin).formats) {
    if (goes_with_its_kind(topics_, format, robot)) {
      attach(source, format.array_type, format.array, kind_topic(entry.kind), kept);
      continue;
    }
    for (const std::string& topic : sensor_topics(entry, format, robot)) {
      attach(source, format.type, format.open, topic, kept);
    }
  }
  return source;
}

void Publishers::on_structure(const sim::Snapshot& snapshot, const FrameTree& frames,
                              const std::vector<Robot>& robots) {
  const sim::Structure& structure = *snapshot.structure;
  Channels kept;
  std::vector<Source> sensors;
  for (std::size_t i = 0; i < structure.sensors.size(); ++i) {
    const sim::SensorEntry& entry = structure.sensors[i];
    sensors.push_back(sensor_source(entry, frames.sensors[i], robot_in(robots, entry.model), kept));
  }
  std::vector<Source> devices;
  for (const sim::DeviceEntry& entry : structure.devices) {
    Source source{std::make_shared<const Label>(Label{entry.name, "world"}), {}};
    const Format& format = ros_kind(entry.kind, entry.library).formats.front();
    if (entry.kind != "drive") {
      attach(source, format.type, format.latched, topic_of(entry.kind, entry.name), kept);
    }
    devices.push_back(std::move(source));
  }
  const Format& odometry = ros_kind("drive").formats.front();
  robots_.clear();
  for (const Robot& robot : robots) {
    Source& source = devices[robot.device];
    source.label = std::make_shared<const Label>(Label{robot.base_frame, robot.odom_frame});
    for (const std::string& topic : robot.odometry_topics) {
      attach(source, odometry.type, odometry.open, topic, kept);
    }
    robots_.push_back(robot.device);
  }
  channels_ = std::move(kept);  // channels that are not kept are shut down here
  batched_.clear();
  for (const auto& [key, channel] : channels_) {
    if (channel->batches()) batched_.push_back(channel);
  }
  sensors_ = std::move(sensors);
  devices_ = std::move(devices);
  list_on_demand(structure);
  for (std::uint32_t i = 0; i < devices_.size(); ++i) {
    if (structure.devices[i].kind != "drive") publish_state(snapshot, i);
  }
}

void Publishers::list_on_demand(const sim::Structure& structure) {
  on_demand_.clear();
  for (std::uint32_t i = 0; i < structure.sensors.size(); ++i) {
    const sim::SensorEntry& entry = structure.sensors[i];
    if (!entry.on_demand()) continue;
    on_demand_.push_back({i, simulation_.requested(entry.kind, entry.name)});
  }
}

// A sensor that samples on demand does so while anybody subscribes.
void Publishers::request(const sim::Structure& structure) {
  for (OnDemand& sensor : on_demand_) {
    const std::vector<std::shared_ptr<Channel>>& channels = sensors_[sensor.sensor].channels;
    const bool wanted = std::any_of(channels.begin(), channels.end(),
                                    [](const auto& channel) { return channel->has_subscribers(); });
    if (wanted == sensor.requested) continue;
    sensor.requested = wanted;
    const sim::SensorEntry& entry = structure.sensors[sensor.sensor];
    simulation_.request(entry.kind, entry.name, wanted);
  }
}

void Publishers::publish(const sim::Snapshot& snapshot) {
  request(*snapshot.structure);
  for (const std::uint32_t i : snapshot.new_states) publish_state(snapshot, i);
  for (const std::uint32_t i : snapshot.new_readings) {
    if (snapshot.sensors[i].reading == nullptr) continue;
    const Source& source = sensors_[i];
    std::shared_ptr<const Reading> reading;
    for (const auto& channel : source.channels) {
      if (!channel->has_subscribers()) continue;
      if (!reading) reading = snapshot.reading(i);
      channel->publish({reading, snapshot.stamp(i), source.label});
    }
  }
  for (const auto& channel : batched_) channel->flush(snapshot.time);
  repeat_odometry(snapshot);
}

void Publishers::publish_state(const sim::Snapshot& snapshot, std::uint32_t device) {
  const std::shared_ptr<const Reading>& state = snapshot.devices[device];
  if (state == nullptr) return;
  const Source& source = devices_[device];
  for (const auto& channel : source.channels) channel->publish({state, state->stamp, source.label});
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
      channel->publish({state, snapshot.time, source.label});
    }
  }
}

}  // namespace angen::node
