#pragma once

#include <angen_msgs/Delete.h>
#include <angen_msgs/List.h>
#include <angen_msgs/Save.h>
#include <angen_msgs/SendCommand.h>
#include <angen_msgs/Spawn.h>
#include <angen_msgs/Step.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <std_srvs/Empty.h>

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "node/status_topics.h"
#include "ros/inbox.h"
#include "ros/queue_threads.h"
#include "ros/taken_topics.h"
#include "ros/topics.h"
#include "sdf/load.h"

namespace angen::node {

constexpr char kListService[] = "angen/list";  // one that each simulator has, in its namespace

/// The services of the node. Parsing happens here, on the thread of the request; the
/// world changes in its own. No exception leaves it: a failure is success = false and a
/// message. Services have threads of their own, and calls that wait long never have all of them.
class Services {
 public:
  /// `models` is a further folder that model:// is searched in.
  Services(Inbox& inbox, const Events& events, const std::string& models, Topics topics);

  /// Its services are served by the same threads.
  const ros::NodeHandle& handle() const { return node_; }

  /// Serves until stop(), which waits for the calls that are being served.
  void start() { threads_.start(); }
  void stop() { threads_.stop(); }

 private:
  using Empty = std_srvs::Empty;
  using StepCall = ros::ServiceEvent<angen_msgs::Step::Request, angen_msgs::Step::Response>;

  bool empty(sim::Action action);
  sim::Outcome take(std::uint32_t ticks, const ros::M_string& client);
  bool step(StepCall& call);
  bool spawn(angen_msgs::Spawn::Request& request, angen_msgs::Spawn::Response& response);
  bool erase(angen_msgs::Delete::Request& request, angen_msgs::Delete::Response& response);
  bool command(angen_msgs::SendCommand::Request& request,
               angen_msgs::SendCommand::Response& response);
  bool list(angen_msgs::List::Request& request, angen_msgs::List::Response& response);
  bool save(angen_msgs::Save::Request& request, angen_msgs::Save::Response& response);
  void check(const std::vector<NewSensor>& sensors);
  sim::Action spawn_action(const angen_msgs::Spawn::Request& request);

  Inbox& inbox_;
  const Events& events_;
  load::SearchPaths paths_;
  Topics topics_;
  std::mutex catalog_mutex_;           // guards the next
  Catalog catalog_;                    // to know the kinds of new sensors by
  std::atomic<std::size_t> steps_{0};  // calls that wait
  ros::CallbackQueue queue_;
  QueueThreads threads_;
  ros::NodeHandle node_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace angen::node
