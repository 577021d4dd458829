#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ros/lazy_publisher.h"
#include "tf/frames.h"

namespace angen::node {

/// Positions of each robot's joints (rad or m), 50 times per simulated second while it has
/// subscribers, as robot_state_publisher expects them.
class JointStates {
 public:
  explicit JointStates(ros::NodeHandle& node) : node_(node) {}

  void on_structure(const sim::Snapshot& snapshot, const std::vector<Robot>& robots);
  void publish(const sim::Snapshot& snapshot);

 private:
  struct Source {
    std::vector<std::uint32_t> joints;  // in Structure::joints
    std::vector<std::string> names;     // without the model's
    std::vector<LazyPublisher> publishers;
    std::vector<double> before;  // their positions at the last message; empty: there was none
  };

  ros::NodeHandle& node_;
  std::map<std::string, LazyPublisher> publishers_;  // by topic
  std::vector<Source> sources_;
  Nanoseconds slot_ = -1;
  Nanoseconds time_ = 0;  // time of the last message
};

}  // namespace angen::node
