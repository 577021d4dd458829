#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "node/commands.h"
#include "node/cost.h"
#include "node/lag_warning.h"
#include "node/publishers.h"
#include "node/scene_topics.h"
#include "node/services.h"
#include "node/status_topics.h"
#include "record/recorder.h"
#include "record/replay.h"
#include "ros/extension.h"
#include "ros/inbox.h"
#include "ros/pacer.h"
#include "ros/readings.h"
#include "rviz/markers.h"
#include "tf/frames.h"
#include "tf/joints.h"
#include "tf/tf.h"

namespace angen::node {

struct Settings {
  double rate = 1.0;          // simulated seconds per wall second; 0 = no limit
  bool fast = false;          // leaps over ticks in which nothing happens; needs rate 0
  double clock_rate = 100.0;  // Hz
  double states_rate = 30.0;  // Hz, of /gazebo/model_states and link_states
  Topics topics = Topics::kSensor;
  std::vector<std::shared_ptr<const Plugin>> plugins;  // whose command topics are always there
  std::string models;  // a folder that model:// is searched in, besides the usual ones
  record::Recorder* recorder = nullptr;  // where the run is recorded
  record::Replay* replay = nullptr;      // runs before commands are accepted; of this simulation
  bool hurry = false;                    // the replay leaps, and does not wait for the rate
  bool paused_after = false;             // the replay
  bool odometry_in_world = true;         // world is the parent of odometry frames
};

/// A simulation in ROS. The thread that calls run() owns the world and publishes; those of
/// subscribers only queue actions, those of services wait for the answers too.
class Node {
 public:
  Node(sim::Simulation& simulation, const Settings& settings);

  enum class End { kStopped, kMasterLost };

  /// Ticks until `stop` or roscpp's end, or until the master was restarted.
  End run(const std::atomic<bool>& stop);

 private:
  std::shared_ptr<const sim::Snapshot> advance();
  void publish(const sim::Snapshot& snapshot);
  void follow_structure(const sim::Snapshot& snapshot);
  /// Sleeps where time is ahead of its schedule by a batch of ticks.
  void pace(const sim::Snapshot& snapshot, const std::atomic<bool>& stop);
  /// Advertises /angen/ready, the last topic: once it is there, so are all others and every
  /// service. Waits for the master until `stop`.
  void announce(const std::atomic<bool>& stop);

  std::shared_ptr<const sim::Snapshot> simulate();
  bool replaying() const { return replay_ != nullptr && !replay_->done(); }
  void end_replay();

  sim::Simulation& simulation_;
  bool fast_;
  record::Recorder* recorder_;
  record::Replay* replay_;
  bool hurry_;
  bool paused_after_;
  ros::NodeHandle handle_;
  Inbox inbox_;
  std::atomic<double> rate_;  // like Settings::rate, but a service may set it
  Pacer pacer_;
  LagWarning lag_;
  std::shared_ptr<const sim::Structure> structure_;  // the last one published
  ClockTopic clock_;
  Stats stats_;
  Diagnostics diagnostics_;
  Events events_;
  CostTopic cost_;
  Readings readings_;
  SummaryTopic summary_;
  HomeTopic home_;
  FrameMaker frames_;
  Transforms transforms_;
  Markers markers_;
  SceneTopics scene_;
  Publishers publishers_;
  JointStates joints_;
  Commands commands_;
  Services services_;
  std::unique_ptr<Extension> gazebo_;  // null: its library is missing
  ros::Publisher ready_;
};

}  // namespace angen::node
