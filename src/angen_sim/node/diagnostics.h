#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include <map>
#include <string>

#include "ros/lazy_publisher.h"
#include "ros/pacer.h"
#include "sim/snapshot.h"

namespace angen::node {

/// /diagnostics, once a second of wall time, for rqt_robot_monitor and others: `angen: time` warns
/// below half of the requested rate, `angen: physics` if the exact solver gave up steps,
/// `angen: sensors` if sensors have had faults.
class Diagnostics {
 public:
  explicit Diagnostics(ros::NodeHandle& node);
  /// `rate` is the requested one, simulated seconds a wall second; 0: no limit.
  void publish(const sim::Snapshot& snapshot, double rate, Pacer::Clock::time_point now);

 private:
  using Status = diagnostic_msgs::DiagnosticStatus;

  void note_faults(const sim::Snapshot& snapshot);
  Status time_status(const sim::Snapshot& snapshot, double rate, double factor) const;
  Status physics_status(const sim::Snapshot& snapshot) const;
  Status sensor_status(const sim::Snapshot& snapshot) const;

  LazyPublisher publisher_;
  Pacer::Clock::time_point sent_ = Pacer::Clock::now();
  Nanoseconds sent_time_ = 0;
  std::uint64_t failed_steps_ = 0;             // at the last message
  std::map<std::string, std::string> faults_;  // the last one of each sensor
};

}  // namespace angen::node
