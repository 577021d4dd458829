#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "plugin/command.h"
#include "sim/snapshot.h"

/// The topics on which devices take messages of their own, as Gazebo's plug-ins do.
namespace angen::node {

/// Subscribes to a topic; `take` gets each message as a command. May throw exceptions of roscpp.
using Subscribe = std::function<ros::Subscriber(ros::NodeHandle& node, const std::string& topic,
                                                const std::function<void(Command)>& take)>;

/// The subscriptions of a kind of device to one type of message.
struct CommandTopicRule {
  using Topics =
      std::function<std::vector<std::string>(const sim::Structure&, const sim::DeviceEntry&)>;

  Subscribe subscribe;
  Topics topics;  // topics of one device; null: its robot's
};

/// A subscription to messages of one type.
template <class Message>
Subscribe subscribe_as(Command (*make)(const Message&)) {
  constexpr std::uint32_t kQueue = 10;
  return [make](ros::NodeHandle& node, const std::string& topic,
                const std::function<void(Command)>& take) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> received =
        [make, take](const boost::shared_ptr<const Message>& message) { take(make(*message)); };
    return node.subscribe<Message>(topic, kQueue, received);
  };
}

/// A command of numbers alone.
inline Command command_of(std::vector<double> values) { return {"", std::move(values), "", 0.0}; }

/// The topic that `parameter` of its <plugin> names, or `fallback`, below <robotNamespace>; none
/// if both are empty.
CommandTopicRule::Topics topics_by_parameter(std::string parameter, std::string fallback);

}  // namespace angen::node
