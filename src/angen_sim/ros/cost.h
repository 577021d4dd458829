#pragma once

#include <angen_msgs/Cost.h>

#include "core/stopwatch.h"
#include "ros/lazy_publisher.h"
#include "ros/pacer.h"
#include "sim/simulation.h"

namespace angen::node {

/// CPU time (ns) of all that the node did between two messages.
struct Spent {
  sim::Cost ticks;
  Nanoseconds publishing = 0;
  Nanoseconds process = 0;  // all threads
  Nanoseconds elapsed = 0;  // wall time
};

/// What that was for each simulated second; the caller fills the header.
angen_msgs::Cost to_message(const Spent& spent);

/// /angen/cost, once a second of wall time. The simulation measures only while it has subscribers.
class CostTopic {
 public:
  CostTopic(ros::NodeHandle& node, sim::Simulation& simulation);

  /// To be called around publishing, publish() at its end.
  void start() { watch_.start(measuring_); }
  void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now);

 private:
  void restart(Pacer::Clock::time_point now);

  sim::Simulation& simulation_;
  LazyPublisher publisher_;
  Stopwatch watch_;
  bool measuring_ = false;
  Pacer::Clock::time_point since_;
  Nanoseconds process_since_ = 0;
  Nanoseconds publishing_ = 0;
};

}  // namespace angen::node
