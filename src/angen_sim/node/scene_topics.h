#pragma once

#include <angen_msgs/Scene.h>
#include <angen_msgs/SceneChanges.h>

#include <memory>
#include <vector>

#include "ros/lazy_publisher.h"
#include "ros/pacer.h"
#include "sim/snapshot.h"

namespace angen::node {

/// /angen/scene, latched, and /angen/scene_changes: poses and light levels for each new
/// subscriber, then changes, at most 20 times a second of wall time. Nothing is made without
/// a subscriber.
class SceneTopics {
 public:
  explicit SceneTopics(ros::NodeHandle& node);

  void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now);

 private:
  void mark_all(const sim::Snapshot& snapshot);
  void mark(std::uint32_t link);
  void add_levels(const sim::Snapshot& snapshot, angen_msgs::SceneChanges& changes);

  LatchedLazyPublisher<angen_msgs::Scene> scene_;
  LazyPublisher changes_;
  std::shared_ptr<const sim::Structure> structure_;  // published last
  std::vector<std::uint32_t> moved_;                 // links, each once
  std::vector<bool> marked_;                         // indexed like Structure::links
  std::vector<double> levels_;                       // published last; NaN: not yet
  std::uint64_t joined_ = 0;
  bool listened_ = false;
  Pacer::Clock::time_point next_{};
};

}  // namespace angen::node
