#include "node/command_topics.h"

#include "ros/ros_kind.h"

namespace angen::node {

std::vector<CommandTopic> command_topics(const sim::Structure& structure,
                                         const std::vector<Robot>& robots) {
  std::vector<CommandTopic> topics;
  for (const sim::DeviceEntry& device : structure.devices) {
    for (const CommandTopicRule& rule : ros_kind(device).commands) {
      if (!rule.topics) continue;
      for (const std::string& topic : rule.topics(structure, device)) {
        topics.push_back({topic, device.kind, device.name, rule.subscribe});
      }
    }
  }
  for (const Robot& robot : robots) {
    const sim::DeviceEntry& device = structure.devices[robot.device];
    for (const std::string& topic : robot.command_topics) {
      topics.push_back(
          {topic, device.kind, device.name, ros_kind(device).commands.front().subscribe});
    }
  }
  return topics;
}

}  // namespace angen::node
