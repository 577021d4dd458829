#include "node/listing.h"

#include <ros/names.h>

#include <algorithm>
#include <tuple>

#include "ros/convert.h"
#include "ros/ros_kind.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

std::vector<std::uint32_t> first_links(const sim::Structure& structure) {
  std::vector<std::uint32_t> first(structure.models.size(), UINT32_MAX);
  for (std::uint32_t i = 0; i < structure.links.size(); ++i) {
    std::uint32_t& slot = first[structure.links[i].model];
    slot = std::min(slot, i);
  }
  return first;
}

}  // namespace

Pose model_pose(const sim::Snapshot& snapshot, std::uint32_t first_link) {
  const sim::LinkEntry& entry = snapshot.structure->links[first_link];
  const desc::Link& link = snapshot.structure->models[entry.model]->links[entry.link];
  return snapshot.link_poses[first_link] * link.pose.inverse();
}

std::vector<angen_msgs::Entity> entities(const sim::Snapshot& snapshot,
                                         const std::vector<desc::Plugin>& world_plugins,
                                         Topics topics, const std::string& kind) {
  const sim::Structure& structure = *snapshot.structure;
  const std::vector<std::uint32_t> first = first_links(structure);
  std::vector<angen_msgs::Entity> all;
  const auto add = [&](const std::string& name, const std::string& its_kind, std::uint32_t model,
                       const Pose& pose) -> angen_msgs::Entity* {
    if (!kind.empty() && kind != its_kind) return nullptr;
    angen_msgs::Entity entity;
    entity.name = name;
    entity.kind = its_kind;
    if (model != UINT32_MAX) entity.model = structure.models[model]->name;
    entity.pose = to_ros(pose);
    entity.room = structure.home->get().room_name_at(pose.position);
    all.push_back(std::move(entity));
    return &all.back();
  };
  const auto place = [&](std::uint32_t model) {
    return first[model] == UINT32_MAX ? structure.models[model]->pose
                                      : model_pose(snapshot, first[model]);
  };
  for (std::uint32_t m = 0; m < structure.models.size(); ++m) {
    add(structure.models[m]->name, "model", m, place(m));
  }
  for (const sim::DeviceEntry& device : structure.devices) {
    const bool of_light = device.light != UINT32_MAX;
    angen_msgs::Entity* entity =
        add(device.name, device.kind, device.model,
            of_light ? structure.lights[device.light].light.pose : place(device.model));
    const RosKind& its = ros_kind(device);
    if (entity == nullptr || its.is_robot) continue;
    const Format& format = its.formats.front();
    const bool together = is_on_topic_of_kind(topics, format, nullptr);
    entity->topic = together ? kind_topic(device.kind) : topic_of(device.kind, device.name);
    entity->type = together ? format.array_type : format.type;
  }
  const std::vector<Robot> robots = find_robots(structure, world_plugins);
  for (const Robot& robot : robots) {
    const sim::DeviceEntry& device = structure.devices[robot.device];
    for (angen_msgs::Entity& entity : all) {
      if (entity.kind != device.kind || entity.name != robot.name) continue;
      entity.topic = robot.odometry_topics.front();
      entity.type = ros_kind(device).formats.front().type;
    }
  }
  for (const sim::SensorEntry& sensor : structure.sensors) {
    angen_msgs::Entity* entity =
        add(sensor.name, sensor.kind, sensor.model, snapshot.link_poses[sensor.link] * sensor.pose);
    if (entity == nullptr) continue;
    const Format& format = ros_kind(sensor).formats.front();
    const Robot* robot = robot_in(robots, sensor.model);
    const bool together = is_on_topic_of_kind(topics, format, robot);
    entity->topic = together ? kind_topic(sensor.kind)
                             : ros::names::resolve(sensor_topics(sensor, format, robot).front());
    entity->type = together ? format.array_type : format.type;
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::tie(a.name, a.kind) < std::tie(b.name, b.kind);
  });
  return all;
}

}  // namespace angen::node
