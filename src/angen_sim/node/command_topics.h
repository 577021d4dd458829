#pragma once

#include <string>
#include <vector>

#include "ros/command_topic.h"
#include "ros/robots.h"

namespace angen::node {

struct CommandTopic {
  std::string topic;
  std::string kind;  // kind of the device that it commands, and its name
  std::string name;
  Subscribe subscribe;
};

/// The topics on which devices take messages of their own, by the rules of their kinds.
std::vector<CommandTopic> command_topics(const sim::Structure& structure,
                                         const std::vector<Robot>& robots);

}  // namespace angen::node
