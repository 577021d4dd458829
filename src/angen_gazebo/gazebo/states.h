#pragma once

#include <gazebo_msgs/LinkStates.h>
#include <gazebo_msgs/ModelStates.h>
#include <geometry_msgs/Twist.h>
#include <ros/node_handle.h>

#include <memory>

#include "ros/inbox.h"
#include "ros/lazy_publisher.h"
#include "ros/pacer.h"
#include "sim/simulation.h"

namespace angen::node::gazebo {

geometry_msgs::Twist twist_of(const sim::Motion& motion);

/// model_states and link_states: so often a simulated second, and ten times a second of wall time
/// while time does not advance; made only while subscribed. Subscribes to set_model_state and
/// set_link_state.
class StateTopics {
 public:
  /// Rate in Hz, positive.
  StateTopics(ros::NodeHandle node, Inbox& inbox, double rate);

  /// The thread that ticks.
  void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now);

 private:
  template <class Message>
  void receive(const Message& message);
  void follow(const sim::Snapshot& snapshot);
  /// Models that can move, were moved by a call, or are new.
  void update(const sim::Snapshot& snapshot);
  void update(const sim::Snapshot& snapshot, std::uint32_t link, bool is_new);
  void fill(std::uint32_t link);

  Inbox& inbox_;
  LazyPublisher models_;
  LazyPublisher links_;
  Nanoseconds period_;
  Nanoseconds slot_ = -1;
  Nanoseconds sent_time_ = -1;
  std::shared_ptr<const sim::Structure> structure_;  // the structure that the messages describe
  gazebo_msgs::ModelStates model_states_;
  gazebo_msgs::LinkStates link_states_;
  Pacer::Clock::time_point sent_{};
  ros::Subscriber set_model_;
  ros::Subscriber set_link_;
};

/// performance_metrics, once a second of wall time while subscribed: how often each sensor
/// published.
class Performance {
 public:
  Performance(ros::NodeHandle node, const sim::Simulation& simulation);
  /// The thread that ticks.
  void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now);

 private:
  const sim::Simulation& simulation_;
  LazyPublisher publisher_;
  Pacer::Clock::time_point sent_ = Pacer::Clock::now();
  Nanoseconds sent_time_ = 0;
};

}  // namespace angen::node::gazebo
