#include "ros/robots.h"

#include <utility>

#include "core/named.h"
#include "ros/ros_kind.h"
#include "ros/wire.h"

namespace angen::node {

std::string value_of(const std::vector<const Element*>& elements, const std::string& key,
                     const std::string& fallback) {
  for (const Element* element : elements) {
    if (const Element* found = element->child(key)) return found->text;
  }
  return fallback;
}

std::vector<std::string> robot_topics(const Robot& robot, const std::string& requested) {
  if (!requested.empty() && requested[0] == '/') return {graph_name(requested)};
  std::vector<std::string> topics = {graph_name(in_namespace(robot.name + "/" + requested))};
  if (robot.first) topics.push_back(graph_name(in_namespace(requested)));
  return topics;
}

const Robot* robot_in(const std::vector<Robot>& robots, std::uint32_t model) {
  for (const Robot& robot : robots) {
    if (robot.model == model) return &robot;
  }
  return nullptr;
}

std::vector<Robot> find_robots(const sim::Structure& structure,
                               const std::vector<desc::Plugin>& world_plugins) {
  std::vector<Robot> robots;
  for (std::uint32_t d = 0; d < structure.devices.size(); ++d) {
    const sim::DeviceEntry& device = structure.devices[d];
    if (!ros_kind(device).is_robot) continue;
    std::vector<const Element*> elements;
    for (const std::vector<desc::Plugin>* plugins :
         {&structure.models[device.model]->plugins, &world_plugins}) {
      for (const desc::Plugin& plugin : *plugins) {
        if (plugin.filename == device.library) elements.push_back(&plugin.element);
      }
    }
    Robot robot;
    robot.device = d;
    robot.model = device.model;
    robot.name = device.name;
    const std::string prefix = robots.empty() ? "" : robot.name + "/";
    const std::string base = value_of(elements, "robotBaseFrame", "base_footprint");
    robot.odom_frame = prefix + value_of(elements, "odometryFrame", "odom");
    robot.base_frame = prefix + base;
    robot.first = robots.empty();
    robot.command_topics = robot_topics(robot, value_of(elements, "commandTopic", "cmd_vel"));
    robot.odometry_topics = robot_topics(robot, value_of(elements, "odometryTopic", "odom"));
    robot.base = structure.first_link(device.model) +
                 index_in(structure.models[device.model]->links, base).value_or(0);
    robots.push_back(std::move(robot));
  }
  return robots;
}

}  // namespace angen::node
