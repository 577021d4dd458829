#pragma once

#include <angen_msgs/Stats.h>

#include <atomic>
#include <cstdint>

#include "core/stopwatch.h"
#include "node/tick_times.h"
#include "ros/lazy_publisher.h"
#include "ros/pacer.h"
#include "sim/snapshot.h"

namespace angen::node {

/// /clock, at a rate in simulated time; while time does not advance, ten times per wall second.
class ClockTopic {
 public:
  /// Rate in Hz, positive.
  ClockTopic(ros::NodeHandle& node, double rate);
  void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now);

 private:
  LazyPublisher publisher_;
  Nanoseconds period_;
  Nanoseconds slot_ = -1;
  Pacer::Clock::time_point sent_{};
};

/// /angen/stats, once a second of wall time.
class Stats {
 public:
  explicit Stats(ros::NodeHandle& node);
  /// A tick begins, which publish() ends; both are timed while there are subscribers.
  void start();
  void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now);

 private:
  angen_msgs::Stats message_of(const sim::Snapshot& snapshot, Pacer::Clock::time_point now,
                               double factor);

  LazyPublisher publisher_;
  Pacer::Clock::time_point start_ = Pacer::Clock::now();
  Pacer::Clock::time_point sent_ = start_;
  Nanoseconds sent_time_ = 0;
  Stopwatch watch_;
  bool timing_ = false;
  TickTimes ticks_;
};

/// /angen/events; rejections and warnings are also logged.
class Events {
 public:
  explicit Events(ros::NodeHandle& node);
  void publish(const sim::Snapshot& snapshot);
  /// The number of published events, with subscribers or without.
  std::uint64_t count() const { return count_; }

 private:
  LazyPublisher publisher_;
  std::atomic<std::uint64_t> count_{0};
};

}  // namespace angen::node
