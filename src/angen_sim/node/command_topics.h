#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <vector>

#include "plugin/command.h"
#include "tf/frames.h"

/// The topics on which devices of robots take messages of their own, as Gazebo's plug-ins do.
namespace angen::node {

/// Makes commands of a topic's messages.
using Subscribe = ros::Subscriber (*)(ros::NodeHandle& node, const std::string& topic,
                                      const std::function<void(Command)>& take);

struct CommandTopic {
  std::string topic;
  std::string kind;  // of the device that takes them, and its name
  std::string name;
  Subscribe subscribe = nullptr;
};

std::vector<CommandTopic> command_topics(const sim::Structure& structure,
                                         const std::vector<Robot>& robots);

/// Throws what roscpp throws.
inline ros::Subscriber subscribe_to(ros::NodeHandle& node, const CommandTopic& topic,
                                    const std::function<void(Command)>& take) {
  return topic.subscribe(node, topic.topic, take);
}

}  // namespace angen::node
