#pragma once

#include <angen_msgs/Delete.h>
#include <angen_msgs/List.h>
#include <angen_msgs/Save.h>
#include <angen_msgs/SendCommand.h>
#include <angen_msgs/Spawn.h>
#include <angen_msgs/Step.h>
#include <ros/node_handle.h>
#include <std_srvs/Empty.h>

#include <string>
#include <vector>

#include "load/load.h"
#include "ros/inbox.h"
#include "ros/status_topics.h"
#include "ros/topics.h"

namespace angen::node {

/// What the node can be requested to do. Parsing happens here, on the thread of the request; the
/// world changes in its own. Nothing is thrown out: what goes wrong is success = false and a
/// message.
class Services {
 public:
  /// `models` is a further folder that model:// is searched in.
  Services(ros::NodeHandle& node, Inbox& inbox, const Events& events, const std::string& models,
           Topics topics);

 private:
  using Empty = std_srvs::Empty;

  bool empty(sim::Action action);
  bool step(angen_msgs::Step::Request& request, angen_msgs::Step::Response& response);
  bool spawn(angen_msgs::Spawn::Request& request, angen_msgs::Spawn::Response& response);
  bool erase(angen_msgs::Delete::Request& request, angen_msgs::Delete::Response& response);
  bool command(angen_msgs::SendCommand::Request& request,
               angen_msgs::SendCommand::Response& response);
  bool list(angen_msgs::List::Request& request, angen_msgs::List::Response& response);
  bool save(angen_msgs::Save::Request& request, angen_msgs::Save::Response& response);
  sim::Action spawn_action(const angen_msgs::Spawn::Request& request) const;

  Inbox& inbox_;
  const Events& events_;
  load::SearchPaths paths_;
  Topics topics_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace angen::node
