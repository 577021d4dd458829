#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ros/lazy_publisher.h"
#include "ros/pacer.h"
#include "ros/readings.h"
#include "sim/snapshot.h"

namespace angen::node {

/// /angen/summary: every sensor and device in a few words, for people who watch. A new subscriber
/// gets all, then changes, at most 4 times per second of wall time.
class SummaryTopic {
 public:
  SummaryTopic(ros::NodeHandle& node, Readings& readings);

  void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now);

 private:
  Readings& readings_;
  LazyPublisher publisher_;
  std::shared_ptr<const sim::Structure> structure_;
  std::vector<Nanoseconds> stamps_;  // last published: sensors, then devices; -1 for none
  std::uint64_t subscriptions_ = 0;
  Pacer::Clock::time_point next_{};
};

}  // namespace angen::node
