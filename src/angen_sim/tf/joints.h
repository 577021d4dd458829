#pragma once

#include <map>
#include <string>
#include <vector>

#include "ros/lazy_publisher.h"
#include "sim/simulation.h"
#include "tf/frames.h"

namespace angen::node {

/// Positions (rad or m), velocities and efforts (N m or N, of joint and motor along the axis) of
/// each robot's joints, 50 times per simulated second while it has subscribers, as
/// robot_state_publisher expects them.
class JointStates {
 public:
  /// The simulation is asked on the thread that ticks it.
  JointStates(ros::NodeHandle& node, const sim::Simulation& simulation)
      : node_(node), simulation_(simulation) {}

  void on_structure(const sim::Snapshot& snapshot, const std::vector<Robot>& robots);
  void publish(const sim::Snapshot& snapshot);

 private:
  struct Source {
    sim::Observation joints;
    std::vector<std::string> names;  // without the model's
    std::vector<LazyPublisher> publishers;
  };

  ros::NodeHandle& node_;
  const sim::Simulation& simulation_;
  std::map<std::string, LazyPublisher> publishers_;  // by topic
  std::vector<Source> sources_;
  Nanoseconds slot_ = -1;
};

}  // namespace angen::node
