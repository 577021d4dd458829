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
  Nanoseconds main = 0;     // the thread that ticks and publishes
  Nanoseconds elapsed = 0;  // wall time
};

/// The costs per simulated second; the caller fills the header.
angen_msgs::Cost to_message(const Spent& spent);

/// The time at which costs are published: after a second of wall time and one of simulated time.
/// The first second after the node's start is left out: in it everything comes to rest.
class CostPeriod {
 public:
  using Time = Pacer::Clock::time_point;
  enum class Due {
    kNo,
    kDiscard,  // the costs are of the first second, or of before a reset
    kStill,    // time does not advance: there is nothing to measure
    kYes,
  };

  void restart(Nanoseconds time, Time now);
  /// To be called after each tick.
  Due check(Nanoseconds time, bool paused, Time now);
  Time since() const { return since_now_; }

 private:
  bool settled(Nanoseconds time, Time now) const;

  bool settled_ = false;
  Nanoseconds last_ = -1;  // time of the last tick; none before the first
  Nanoseconds first_ = 0;  // start of the node
  Time first_now_;
  Nanoseconds since_ = 0;  // start of the period
  Time since_now_;
};

/// /angen/cost, once a second of wall time. The simulation measures only while it has subscribers.
class CostTopic {
 public:
  CostTopic(ros::NodeHandle& node, sim::Simulation& simulation);

  /// To be called around publishing, publish() at its end.
  void start() { watch_.start(measuring_); }
  void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now);

 private:
  void restart(const sim::Snapshot& snapshot, Pacer::Clock::time_point now);

  sim::Simulation& simulation_;
  LazyPublisher publisher_;
  Stopwatch watch_;
  bool measuring_ = false;
  CostPeriod period_;
  Nanoseconds process_since_ = 0;
  Nanoseconds main_since_ = 0;
  Nanoseconds publishing_ = 0;
};

}  // namespace angen::node
