#pragma once

#include <tf2_msgs/TFMessage.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "ros/lazy_publisher.h"
#include "ros/pacer.h"
#include "sim/snapshot.h"
#include "tf/frames.h"

namespace angen::node {

/// /tf_static whole when there are new frames, but at most once a second of wall time; until then
/// only new frames. /tf for moving frames: when one is new or has moved, at most 50 times a
/// simulated second, and all of them once a second and for each new subscriber. No transform is
/// sent twice with one stamp, which tf2 warns of, but to a newcomer during a pause.
class Transforms {
 public:
  explicit Transforms(ros::NodeHandle& node);

  void on_structure(const sim::Snapshot& snapshot, std::shared_ptr<const FrameTree> frames,
                    const std::vector<Robot>& robots, const Changes& changes);
  void publish(const sim::Snapshot& snapshot);

 private:
  void fix(Nanoseconds now, const FrameTree* before);
  bool whole_is_due() const;
  void send_whole();
  void mark(std::int32_t frame);
  /// Transforms not sent with this snapshot's stamp; `again`: also those that were.
  tf2_msgs::TFMessage collect(const sim::Snapshot& snapshot, bool all, bool again);

  LatchedLazyPublisher<tf2_msgs::TFMessage> fixed_;
  Pacer::Clock::time_point whole_sent_{};  // when fixed_ was sent
  bool whole_waits_ = false;
  LazyPublisher moving_;
  std::shared_ptr<const FrameTree> frames_;
  std::vector<Robot> robots_;
  std::vector<std::uint32_t> moved_;  // indices in frames_->moving since the last message
  std::vector<bool> marked_;
  std::set<std::string> sent_;  // child frames sent with the stamp sent_at_
  Nanoseconds sent_at_ = -1;
  bool new_structure_ = false;
  bool new_robots_ = false;
  Nanoseconds slot_ = 0;
  Nanoseconds second_ = 0;
  std::uint64_t joined_ = 0;
};

}  // namespace angen::node
