#include "node/master_watch.h"

#include <ros/console.h>
#include <ros/master.h>
#include <ros/this_node.h>

#include <chrono>
#include <optional>
#include <string>

namespace angen::node {
namespace {

constexpr std::chrono::seconds kMasterPeriod(1);

enum class Answer { kNone, kError, kGood };

// Without a retry: ros::master waits forever otherwise.
Answer call_master(const char* method, const std::string& about, XmlRpc::XmlRpcValue& payload) {
  XmlRpc::XmlRpcValue request, response;
  request[0] = ros::this_node::getName();
  if (!about.empty()) request[1] = about;
  if (ros::master::execute(method, request, response, payload, false)) return Answer::kGood;
  return response.getType() == XmlRpc::XmlRpcValue::TypeArray ? Answer::kError : Answer::kNone;
}

std::optional<int> pid_of_master() {
  XmlRpc::XmlRpcValue pid;
  const bool good = call_master("getPid", "", pid) == Answer::kGood;
  return good && pid.getType() == XmlRpc::XmlRpcValue::TypeInt ? std::optional<int>(pid)
                                                               : std::nullopt;
}

}  // namespace

MasterWatch::MasterWatch() : thread_([this] { watch(); }) {}

MasterWatch::~MasterWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void MasterWatch::watch() {
  std::optional<int> first;
  bool answered = true;
  std::unique_lock<std::mutex> lock(mutex_);
  while (!wake_.wait_for(lock, kMasterPeriod, [this] { return ended_; })) {
    const std::optional<int> pid = pid_of_master();
    XmlRpc::XmlRpcValue uri;
    const Answer registered = call_master("lookupNode", ros::this_node::getName(), uri);
    if (pid && !first) first = pid;
    if ((pid && pid != first) || registered == Answer::kError) {
      lost_ = true;
      return;
    }
    const bool answers = pid && registered == Answer::kGood;
    if (answers == answered) continue;
    answered = answers;
    if (answers) {
      ROS_INFO("the ROS master answers again");
    } else {
      ROS_WARN("the ROS master at %s does not answer; the simulation continues and waits for it",
               ros::master::getURI().c_str());
    }
  }
}

}  // namespace angen::node
