#pragma once

#include <geometry_msgs/Twist.h>
#include <ros/node_handle.h>

#include "ros/inbox.h"
#include "ros/lazy_publisher.h"
#include "ros/pacer.h"

namespace angen::node::gazebo {

geometry_msgs::Twist twist_of(const sim::Motion& motion);

/// model_states and link_states: so often a simulated second, and ten times a second of wall time
/// while time stands still; made only while subscribed. Subscribes to set_model_state and
/// set_link_state.
class StateTopics {
 public:
  /// Rate in Hz, positive.
  StateTopics(ros::NodeHandle& node, Inbox& inbox, double rate);

  /// The thread that ticks.
  void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now);

 private:
  template <class Message>
  void receive(const Message& message);

  Inbox& inbox_;
  LazyPublisher models_;
  LazyPublisher links_;
  Nanoseconds period_;
  Nanoseconds slot_ = -1;
  Pacer::Clock::time_point sent_{};
  ros::Subscriber set_model_;
  ros::Subscriber set_link_;
};

}  // namespace angen::node::gazebo
