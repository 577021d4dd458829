#pragma once

#include <ros/node_handle.h>

#include "ros/lazy_publisher.h"
#include "ros/pacer.h"
#include "sim/simulation.h"

namespace angen::node::gazebo {

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
