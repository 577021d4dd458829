#include "ros/gazebo/states.h"

#include <gazebo_msgs/LinkState.h>
#include <gazebo_msgs/LinkStates.h>
#include <gazebo_msgs/ModelState.h>
#include <gazebo_msgs/ModelStates.h>
#include <ros/console.h>

#include <algorithm>
#include <chrono>

#include "core/text.h"
#include "ros/convert.h"
#include "ros/gazebo/links.h"
#include "ros/gazebo/models.h"

namespace angen::node::gazebo {

namespace {

constexpr std::chrono::milliseconds kStandingPeriod(100);  // while time stands still
constexpr std::uint32_t kStatesQueue = 10;

template <class Message>
void add(const std::string& name, const sim::Motion& motion, Message& message) {
  message.name.push_back(name);
  message.pose.push_back(to_ros(motion.pose));
  message.twist.push_back(twist_of(motion));
}

gazebo_msgs::LinkStates link_states(const sim::Simulation& simulation,
                                    const sim::Snapshot& snapshot) {
  gazebo_msgs::LinkStates message;
  const std::vector<sim::LinkEntry>& links = snapshot.structure->links;
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    add(links[i].name, simulation.motion(i), message);
  }
  return message;
}

// A model goes with its first link.
gazebo_msgs::ModelStates model_states(const sim::Simulation& simulation,
                                      const sim::Snapshot& snapshot) {
  gazebo_msgs::ModelStates message;
  const std::vector<sim::LinkEntry>& links = snapshot.structure->links;
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    if (links[i].link != 0) continue;
    const desc::Model& model = *snapshot.structure->models[links[i].model];
    sim::Motion motion = simulation.motion(i);
    const Vec3 link = motion.pose.position;
    motion.pose = motion.pose * model.links.front().pose.inverse();
    motion.linear += motion.angular.cross(motion.pose.position - link);
    add(model.name, motion, message);
  }
  return message;
}

}  // namespace

geometry_msgs::Twist twist_of(const sim::Motion& motion) {
  geometry_msgs::Twist twist;
  twist.linear = to_vector(motion.linear);
  twist.angular = to_vector(motion.angular);
  return twist;
}

StateTopics::StateTopics(ros::NodeHandle& node, Inbox& inbox, double rate)
    : inbox_(inbox),
      models_(
          LazyPublisher::of<gazebo_msgs::ModelStates>(node, "/gazebo/model_states", kStatesQueue)),
      links_(LazyPublisher::of<gazebo_msgs::LinkStates>(node, "/gazebo/link_states", kStatesQueue)),
      period_(std::max<Nanoseconds>(1, from_seconds(1.0 / rate))) {
  const boost::function<void(const gazebo_msgs::ModelState::ConstPtr&)> model =
      [this](const gazebo_msgs::ModelState::ConstPtr& state) { receive(*state); };
  set_model_ =
      node.subscribe<gazebo_msgs::ModelState>("/gazebo/set_model_state", kStatesQueue, model);
  const boost::function<void(const gazebo_msgs::LinkState::ConstPtr&)> link =
      [this](const gazebo_msgs::LinkState::ConstPtr& state) { receive(*state); };
  set_link_ = node.subscribe<gazebo_msgs::LinkState>("/gazebo/set_link_state", kStatesQueue, link);
}

template <class Message>
void StateTopics::receive(const Message& message) {
  try {
    inbox_.post(edit_of(*inbox_.simulation().snapshot()->structure, message));
  } catch (const Error& error) {
    ROS_WARN("a state that was published to be set: %s", printable(error.what(), 2000).c_str());
  }
}

void StateTopics::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  if (!models_.has_subscribers() && !links_.has_subscribers()) return;
  const Nanoseconds slot = snapshot.time / period_;
  if (slot == slot_ && now - sent_ < kStandingPeriod) return;
  slot_ = slot;
  sent_ = now;
  models_.publish([&] { return model_states(inbox_.simulation(), snapshot); });
  links_.publish([&] { return link_states(inbox_.simulation(), snapshot); });
}

}  // namespace angen::node::gazebo
