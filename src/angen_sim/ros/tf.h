#pragma once

#include <tf2_msgs/TFMessage.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "ros/frames.h"
#include "ros/lazy_publisher.h"
#include "sim/snapshot.h"

namespace angen::node {

/// /tf_static once for each structure, /tf for what moves: when it has moved, at most 50 times a
/// simulated second, and all of it once a second, for each newcomer and for each structure. No
/// transform goes out twice with one stamp, which tf2 warns of, but to a newcomer during a pause.
class Transforms {
 public:
  explicit Transforms(ros::NodeHandle& node);

  void on_structure(const sim::Snapshot& snapshot, const FrameTree& frames,
                    const std::vector<Robot>& robots);
  void publish(const sim::Snapshot& snapshot);

 private:
  /// What has not been sent with this snapshot's stamp; `again`: that, too.
  tf2_msgs::TFMessage collect(const sim::Snapshot& snapshot, bool all, bool again);

  LatchedLazyPublisher<tf2_msgs::TFMessage> fixed_;
  LazyPublisher moving_;
  FrameTree frames_;
  std::vector<Robot> robots_;
  std::vector<std::uint32_t> moved_;  // indices in frames_.moving since the last message
  std::vector<bool> marked_;
  std::set<std::string> sent_;  // child frames sent with the stamp sent_at_
  Nanoseconds sent_at_ = -1;
  bool new_structure_ = false;
  Nanoseconds slot_ = 0;
  Nanoseconds second_ = 0;
  std::uint64_t joined_ = 0;
};

}  // namespace angen::node
