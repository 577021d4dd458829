#include "ros/registrar.h"

#include <pthread.h>
#include <ros/console.h>
#include <ros/exceptions.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/this_node.h>

#include <csignal>

namespace angen::node {
namespace {

/// Waits for an answer of the master, or the end of ROS. roscpp holds locks that publishing needs
/// while it removes a topic, so that a master that does not answer would stop the simulation.
void wait_for_master() {
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = ros::this_node::getName();
  ros::master::execute("getPid", request, response, payload, true);
}

}  // namespace

Registrar& Registrar::instance() {
  static Registrar one;
  return one;
}

Registrar::Registrar() : thread_([this] { run(); }) {}

Registrar::~Registrar() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void Registrar::post(std::function<void()> call) {
  if (!ros::ok()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  ++pending_;
  calls_.push_back(std::move(call));
  wake_.notify_all();
}

void Registrar::run() {
  sigset_t all;  // the main thread takes signals
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return ended_ || !calls_.empty(); });
    if (calls_.empty()) return;
    std::function<void()> call = std::move(calls_.front());
    calls_.pop_front();
    lock.unlock();
    wait_for_master();
    try {
      if (ros::ok()) call();
    } catch (const ros::Exception& error) {
      ROS_WARN("a topic is not registered: %s", error.what());
    }
    call = nullptr;  // with what it removes
    --pending_;
    lock.lock();
  }
}

}  // namespace angen::node
