#include "ros/node.h"

#include <ros/spinner.h>
#include <std_msgs/Bool.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "ros/frames.h"

namespace angen::node {
namespace {

constexpr std::uint32_t kThreads = 4;
constexpr std::chrono::milliseconds kPausedNap(20);
constexpr std::chrono::milliseconds kLongestNap(100);  // Ctrl-C is seen that soon
// Sleeping for single milliseconds would wake the processor more often than anybody can see.
constexpr std::chrono::milliseconds kShortestNap(2);

constexpr Nanoseconds kLongestLeap = 10 * kSecond;  // so far may /clock jump

}  // namespace

Node::Node(sim::Simulation& simulation, const Settings& settings)
    : simulation_(simulation),
      fast_(settings.fast),
      inbox_(simulation),
      pacer_(settings.rate),
      clock_(handle_, settings.clock_rate),
      stats_(handle_),
      events_(handle_),
      cost_(handle_, simulation),
      transforms_(handle_),
      markers_(handle_),
      publishers_(handle_, simulation, settings.topics),
      joints_(handle_),
      commands_(handle_, inbox_),
      services_(handle_, inbox_, events_, settings.models, settings.topics) {}

void Node::run(const std::atomic<bool>& stop) {
  ros::AsyncSpinner spinner(kThreads);
  spinner.start();
  while (!stop && ros::ok()) {
    const std::shared_ptr<const sim::Snapshot> snapshot = advance();
    pass(*snapshot);
    inbox_.passed();
    if (!ready_) announce();
    rest(*snapshot);
  }
  inbox_.close();
  spinner.stop();
}

void Node::announce() {
  ready_ = handle_.advertise<std_msgs::Bool>("/angen/ready", 1, true);
  std_msgs::Bool ready;
  ready.data = true;
  ready_.publish(ready);
}

std::shared_ptr<const sim::Snapshot> Node::advance() {
  return fast_ ? simulation_.leap(simulation_.snapshot()->time + kLongestLeap) : simulation_.tick();
}

void Node::pass(const sim::Snapshot& snapshot) {
  cost_.start();
  const Pacer::Clock::time_point now = Pacer::Clock::now();
  clock_.pass(snapshot, now);
  if (snapshot.structure->revision != revision_) {
    revision_ = snapshot.structure->revision;
    const std::vector<Robot> robots = find_robots(*snapshot.structure, simulation_.world().plugins);
    const FrameTree frames = make_frames(snapshot, robots);
    transforms_.follow(snapshot, frames, robots);
    publishers_.follow(snapshot, frames, robots);
    joints_.follow(snapshot, robots);
    commands_.follow(robots);
  }
  publishers_.pass(snapshot);
  joints_.pass(snapshot);
  transforms_.pass(snapshot);
  markers_.pass(snapshot, now);
  events_.pass(snapshot);
  stats_.pass(snapshot, now);
  cost_.pass(snapshot, now);
}

void Node::rest(const sim::Snapshot& snapshot) {
  if (snapshot.paused) {
    pacer_.restart();
    if (!simulation_.running()) inbox_.wait(kPausedNap);
    return;
  }
  const auto ahead = pacer_.ahead(snapshot.time, Pacer::Clock::now());
  if (ahead >= kShortestNap) {
    std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(ahead, kLongestNap));
  }
}

}  // namespace angen::node
