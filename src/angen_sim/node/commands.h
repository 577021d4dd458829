#pragma once

#include <angen_msgs/Command.h>
#include <ros/node_handle.h>
#include <std_msgs/String.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ros/command_topic.h"
#include "ros/inbox.h"
#include "ros/registrar.h"
#include "ros/robots.h"
#include "tf/frames.h"

namespace angen::node {

/// Command topics: one subscription serves all devices of a kind, devices of a robot have their
/// own. And the topic by which programs add to the event log.
class Commands {
 public:
  /// Kinds of `plugins` have their topic also where the world has none of them.
  Commands(ros::NodeHandle& node, Inbox& inbox, std::vector<std::shared_ptr<const Plugin>> plugins);

  /// Subscribes to the command topics of the kinds and robots that exist now, and to no others.
  void on_structure(const sim::Structure& structure, const std::vector<Robot>& robots);

 private:
  void on_kinds(const sim::Structure& structure);
  void subscribe(const std::shared_ptr<const Plugin>& plugin);
  void receive(const Plugin& plugin, const std::string& text);

  ros::NodeHandle& node_;
  Inbox& inbox_;
  std::vector<std::shared_ptr<const Plugin>> always_;
  ros::Subscriber any_;                                       // /angen/command
  ros::Subscriber notes_;                                     // /angen/events/add
  std::map<std::string, Registered<ros::Subscriber>> kinds_;  // by kind
  std::map<std::pair<std::string, std::string>, Registered<ros::Subscriber>>
      own_;  // by topic and device
};

}  // namespace angen::node
