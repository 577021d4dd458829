#include "node/node.h"

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/param.h>
#include <std_msgs/Bool.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "core/stopwatch.h"
#include "node/master_watch.h"
#include "ros/changes.h"
#include "ros/queue_threads.h"
#include "ros/registrar.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

constexpr std::uint32_t kSubscriberThreads = 2;  // threads of subscribers, which never wait
constexpr std::chrono::milliseconds kNap(1);
constexpr std::chrono::milliseconds kPausedNap(20);
constexpr std::chrono::milliseconds kLongestNap(100);  // Ctrl-C is seen that soon

constexpr Nanoseconds kLongestLeap = 10 * kSecond;  // the longest jump of /clock

/// The parameter tf_prefix of a namespace or of one above it, as robot_state_publisher reads it.
std::string tf_prefix_in(const std::string& space) {
  std::string key, prefix;
  if (ros::param::search(graph_name(in_namespace(space)), "tf_prefix", key))
    ros::param::get(key, prefix);
  return prefix;
}

/// Serves topics and services while it lives.
class Serving {
 public:
  Serving(Inbox& inbox, Services& services)
      : inbox_(inbox),
        services_(services),
        subscribers_(*ros::getGlobalCallbackQueue(), kSubscriberThreads) {
    subscribers_.start();
    services_.start();
  }
  ~Serving() {
    inbox_.close();
    services_.stop();
    subscribers_.stop();
  }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;

 private:
  Inbox& inbox_;
  Services& services_;
  QueueThreads subscribers_;
};

}  // namespace

Node::Node(sim::Simulation& simulation, const Settings& settings)
    : simulation_(simulation),
      fast_(settings.fast),
      recorder_(settings.recorder),
      replay_(settings.replay),
      hurry_(settings.hurry),
      paused_after_(settings.paused_after),
      inbox_(simulation),
      rate_(settings.rate),
      pacer_(settings.rate),
      clock_(handle_, settings.clock_rate),
      stats_(handle_),
      diagnostics_(handle_),
      events_(handle_),
      cost_(handle_, simulation),
      summary_(handle_, readings_),
      home_(handle_),
      frames_(settings.odometry_in_world, tf_prefix_in),
      transforms_(handle_),
      markers_(handle_, readings_),
      scene_(handle_),
      publishers_(handle_, simulation, settings.topics, readings_),
      joints_(handle_, simulation),
      commands_(handle_, inbox_, settings.plugins),
      services_(inbox_, events_, settings.models, settings.topics),
      gazebo_(make_extension("libangen_gazebo.so",
                             {simulation, inbox_, rate_, handle_, services_.handle(),
                              settings.models, settings.topics, settings.states_rate})) {}

Node::End Node::run(const std::atomic<bool>& stop) {
  const Serving serving(inbox_, services_);
  std::optional<MasterWatch> master;
  while (!stop && ros::ok() && !(master && master->lost())) {
    const std::shared_ptr<const sim::Snapshot> snapshot = advance();
    publish(*snapshot);
    if (!ready_) {
      announce(stop);
      master.emplace();
    }
    if (Registrar::instance().idle()) inbox_.published();
    if (rate_ > 0.0) simulation_.look_ahead();
    pace(*snapshot, stop);
  }
  return master && master->lost() ? End::kMasterLost : End::kStopped;
}

void Node::announce(const std::atomic<bool>& stop) {
  while (!Registrar::instance().idle() && !stop && ros::ok()) std::this_thread::sleep_for(kNap);
  ready_ = handle_.advertise<std_msgs::Bool>("angen/ready", 1, true);
  std_msgs::Bool ready;
  ready.data = true;
  ready_.publish(ready);
}

std::shared_ptr<const sim::Snapshot> Node::advance() {
  stats_.start();
  if (recorder_ == nullptr) return simulate();
  std::shared_ptr<const sim::Snapshot> snapshot = simulate();
  recorder_->add(*snapshot);
  if (!recorder_->error().empty()) {
    ROS_ERROR("%s", recorder_->error().c_str());
    recorder_ = nullptr;
  }
  return snapshot;
}

std::shared_ptr<const sim::Snapshot> Node::simulate() {
  const std::shared_ptr<const sim::Snapshot> here = simulation_.snapshot();
  Nanoseconds until = here->time + kLongestLeap;
  if (recorder_ != nullptr) until = std::min(until, recorder_->leap_limit(*here));
  if (replaying()) {
    std::shared_ptr<const sim::Snapshot> snapshot = replay_->advance(until);
    if (replay_->done()) end_replay();
    return snapshot;
  }
  const bool may_leap = fast_ && pacer_.rate() == 0.0 && !(gazebo_ && gazebo_->needs_ticks());
  return may_leap ? simulation_.leap(until) : simulation_.tick();
}

void Node::end_replay() {
  const std::string& path = replay_->log().path;
  if (!replay_->log().truncated.empty()) ROS_WARN("%s", replay_->log().truncated.c_str());
  if (!replay_->mismatch().empty()) ROS_ERROR("%s", replay_->mismatch().c_str());
  ROS_INFO("%s: %zu actions replayed, %zu fingerprints were equal; live from %.3f s", path.c_str(),
           replay_->actions(), replay_->compared(), to_seconds(simulation_.snapshot()->time));
  pacer_.restart();
  if (paused_after_) simulation_.post(sim::Pause{true});
}

void Node::follow_structure(const sim::Snapshot& snapshot) {
  const Changes changes = changes_between(structure_.get(), *snapshot.structure);
  structure_ = snapshot.structure;
  home_.on_structure(*structure_);
  const std::vector<Robot> robots = find_robots(*structure_, simulation_.world().plugins);
  const std::shared_ptr<const FrameTree> frames = frames_.make(snapshot, robots, changes);
  transforms_.on_structure(snapshot, frames, robots, changes);
  publishers_.on_structure(snapshot, *frames, robots, changes);
  joints_.on_structure(snapshot, robots);
  commands_.on_structure(*structure_, robots);
  if (gazebo_) gazebo_->on_structure(*structure_, changes);
}

void Node::publish(const sim::Snapshot& snapshot) {
  cost_.start();
  const Pacer::Clock::time_point now = Pacer::Clock::now();
  clock_.publish(snapshot, now);
  if (snapshot.structure != structure_) follow_structure(snapshot);
  publishers_.publish(snapshot);
  joints_.publish(snapshot);
  if (gazebo_) gazebo_->publish(snapshot, now);
  transforms_.publish(snapshot);
  markers_.publish(snapshot, now);
  scene_.publish(snapshot, now);
  events_.publish(snapshot);
  summary_.publish(snapshot, now);
  stats_.publish(snapshot, now);
  diagnostics_.publish(snapshot, rate_, now);
  cost_.publish(snapshot, now);
  const std::string lag =
      lag_.update(snapshot.time, rate_, snapshot.paused, now, Stopwatch::system_clocks().cpu);
  if (!lag.empty()) ROS_WARN("%s", lag.c_str());
  if (gazebo_ && !replaying()) gazebo_->control(snapshot);
}

void Node::pace(const sim::Snapshot& snapshot, const std::atomic<bool>& stop) {
  pacer_.set_rate(rate_);
  if (replaying() && (hurry_ || snapshot.paused)) {
    pacer_.restart();
    return;
  }
  if (snapshot.paused) {
    pacer_.restart();
    if (!simulation_.running()) inbox_.wait(kPausedNap);
    return;
  }
  const auto ahead = [&] { return pacer_.ahead(snapshot.time, Pacer::Clock::now()); };
  if (ahead() < Pacer::kBatch) return;
  // A command need not wait for the schedule: the ticks that a batch has left carry it out.
  std::chrono::nanoseconds enough(0);
  for (auto left = ahead(); left > enough && !stop; left = ahead()) {
    if (inbox_.wait(std::min<std::chrono::nanoseconds>(left - enough, kLongestNap))) {
      enough = Pacer::kBatch;
    }
  }
}

}  // namespace angen::node
