#pragma once

#include <angen_msgs/Home.h>
#include <angen_msgs/Stats.h>
#include <diagnostic_msgs/DiagnosticArray.h>

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/stopwatch.h"
#include "node/tick_times.h"
#include "node/wall_second.h"
#include "ros/lazy_publisher.h"
#include "ros/pacer.h"
#include "ros/readings.h"
#include "sim/snapshot.h"

/// Topics about the world and the node as a whole.
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
  WallSeconds wall_;
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

/// /angen/home: the home's description, again whenever a model that it depends on is added or
/// removed.
class HomeTopic {
 public:
  explicit HomeTopic(ros::NodeHandle& node);

  void on_structure(const sim::Structure& structure);

 private:
  LatchedLazyPublisher<angen_msgs::Home> publisher_;
  std::shared_ptr<const DerivedHome> home_;  // the last one published
};

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
  WallSeconds wall_;
  std::uint64_t failed_steps_ = 0;             // at the last message
  std::map<std::string, std::string> faults_;  // the last one of each sensor
};

}  // namespace angen::node
