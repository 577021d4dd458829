#include "node/publishers.h"

#include <ros/console.h>
#include <ros/exceptions.h>

#include <iterator>
#include <utility>

#include "node/freed_memory.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

constexpr Nanoseconds kOdometryPeriod = kSecond / 10;  // for a robot at rest

// The part of a robot that its sensors' topics depend on.
std::string space_of(const Robot* robot) {
  return robot == nullptr ? "" : robot->name + (robot->first ? " first" : "");
}

}  // namespace

void Publishers::attach(Source& source, const std::string& type, const Format::Open& open,
                        const std::string& topic) {
  std::shared_ptr<Channel>& channel = channels_[{topic, type}];
  if (channel == nullptr) {
    try {
      channel = open(node_, topic);
    } catch (const ros::Exception& error) {
      channels_.erase({topic, type});
      ROS_WARN("%s is not published: %s", source.label->name.c_str(), error.what());
      return;
    }
  }
  source.channels.push_back(channel);
}

Publishers::Source Publishers::sensor_source(const sim::SensorEntry& entry, const Label& label,
                                             const Robot* robot) {
  Source source{std::make_shared<const Label>(label), {}, space_of(robot)};
  const RosKind& kind = ros_kind(entry);
  if (kind.published_elsewhere && kind.published_elsewhere(entry)) return source;
  for (const Format& format : kind.formats) {
    if (is_on_topic_of_kind(topics_, format, robot)) {
      attach(source, format.array_type, format.array, kind_topic(entry.kind));
      continue;
    }
    for (const std::string& topic : sensor_topics(entry, format, robot)) {
      attach(source, format.type, format.open, topic);
    }
  }
  return source;
}

void Publishers::follow_sensors(const sim::Structure& structure, const FrameTree& frames,
                                const std::vector<Robot>& robots, const Numbers& numbers) {
  std::size_t kept = 0;  // sensors that stay where they are
  while (kept < numbers.before.size() && numbers.before[kept] == kept) ++kept;
  std::vector<Source> others(std::make_move_iterator(sensors_.begin() + kept),
                             std::make_move_iterator(sensors_.end()));
  std::vector<Source> removed;
  sensors_.resize(structure.sensors.size());
  for (std::uint32_t i = 0; i < structure.sensors.size(); ++i) {
    const sim::SensorEntry& entry = structure.sensors[i];
    const std::string& frame = frames.sensors[i];
    const std::string& name = frames.bases[i].empty() ? entry.name : frames.bases[i];
    const Robot* robot = robot_in(robots, entry.model);
    const std::uint32_t before = numbers.before[i];
    Source& source = sensors_[i];
    if (i >= kept && before != Numbers::kNone) source = std::move(others[before - kept]);
    if (before == Numbers::kNone || source.robot != space_of(robot)) {
      removed.push_back(std::exchange(source, sensor_source(entry, {name, frame}, robot)));
    } else if (source.label->frame != frame) {
      source.label = std::make_shared<const Label>(Label{name, frame});
    }
  }
}

Publishers::Source Publishers::device_source(const sim::DeviceEntry& entry) {
  Source source{std::make_shared<const Label>(Label{entry.name, kWorldFrame}), {}, ""};
  const RosKind& kind = ros_kind(entry);
  const Format& format = kind.formats.front();
  if (is_on_topic_of_kind(topics_, format, nullptr)) {
    attach(source, format.array_type, format.latched_array, kind_topic(entry.kind));
  } else if (!kind.is_robot) {
    attach(source, format.type, format.latched, topic_of(entry.kind, entry.name));
  }
  return source;
}

std::vector<Publishers::Source> Publishers::device_sources(const sim::Structure& structure,
                                                           const std::vector<Robot>& robots,
                                                           const Numbers& numbers) {
  robots_.clear();
  for (const Robot& robot : robots) robots_.push_back(robot.device);
  std::vector<Source> sources;
  sources.reserve(structure.devices.size());
  for (std::uint32_t i = 0; i < structure.devices.size(); ++i) {
    const sim::DeviceEntry& entry = structure.devices[i];
    const std::uint32_t before = numbers.before[i];
    const bool stays = before != Numbers::kNone && !is_robot(i);
    sources.push_back(stays ? std::move(devices_[before]) : device_source(entry));
  }
  for (const Robot& robot : robots) {
    const Format& odometry = ros_kind(structure.devices[robot.device]).formats.front();
    Source& source = sources[robot.device];
    source.label = std::make_shared<const Label>(Label{robot.base_frame, robot.odom_frame});
    for (const std::string& topic : robot.odometry_topics) {
      attach(source, odometry.type, odometry.open, topic);
    }
  }
  return sources;
}

void Publishers::shut_down_unused() {
  for (auto at = channels_.begin(); at != channels_.end();) {
    at = at->second.use_count() <= 1 ? channels_.erase(at) : std::next(at);
  }
}

void Publishers::on_structure(const sim::Snapshot& snapshot, const FrameTree& frames,
                              const std::vector<Robot>& robots, const Changes& changes) {
  const sim::Structure& structure = *snapshot.structure;
  batched_.clear();
  // Removed sources keep their channels until others have theirs: a shared topic is not closed.
  follow_sensors(structure, frames, robots, changes.sensors);
  devices_ = device_sources(structure, robots, changes.devices);
  shut_down_unused();
  for (const auto& [key, channel] : channels_) {
    if (channel->batches()) batched_.push_back(channel);
  }
  list_on_demand(structure);
  for (std::uint32_t i = 0; i < devices_.size(); ++i) {
    if (!is_robot(i)) publish_state(snapshot, i);
  }
}

void Publishers::list_on_demand(const sim::Structure& structure) {
  on_demand_.clear();
  for (std::uint32_t i = 0; i < structure.sensors.size(); ++i) {
    const sim::SensorEntry& entry = structure.sensors[i];
    if (!entry.on_demand()) continue;
    on_demand_.push_back(
        {i, simulation_.requested(entry.kind, entry.name), ros_kind(entry).is_camera});
  }
  prepare_for_images();
}

void Publishers::prepare_for_images() {
  const bool expected = std::any_of(on_demand_.begin(), on_demand_.end(), [](const OnDemand& each) {
    return each.requested && each.is_camera;
  });
  if (std::exchange(expects_images_, expected) != expected) keep_freed_memory(expected);
}

// A sensor that samples on demand does so while its topic has subscribers.
void Publishers::request(const sim::Structure& structure) {
  for (OnDemand& sensor : on_demand_) {
    const std::vector<std::shared_ptr<Channel>>& channels = sensors_[sensor.sensor].channels;
    const bool requested = std::any_of(channels.begin(), channels.end(), [](const auto& channel) {
      return channel->has_subscribers();
    });
    if (requested == sensor.requested) continue;
    sensor.requested = requested;
    const sim::SensorEntry& entry = structure.sensors[sensor.sensor];
    simulation_.request(entry.kind, entry.name, requested);
    if (sensor.is_camera) prepare_for_images();
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
      if (!reading) reading = readings_.of(snapshot, i);
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
