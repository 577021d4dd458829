#include "tf/joints.h"

#include <sensor_msgs/JointState.h>

#include <utility>

#include "ros/convert.h"

namespace angen::node {
namespace {

constexpr Nanoseconds kJointPeriod = kSecond / 50;
constexpr std::uint32_t kJointQueue = 20;

}  // namespace

void JointStates::on_structure(const sim::Snapshot& snapshot, const std::vector<Robot>& robots) {
  const sim::Structure& structure = *snapshot.structure;
  const std::map<std::string, LazyPublisher> old = std::exchange(publishers_, {});
  sources_.clear();
  for (const Robot& robot : robots) {
    Source source;
    for (const sim::JointEntry& entry : structure.joints) {
      if (entry.model != robot.model) continue;
      const desc::Joint& joint = structure.described(entry);
      if (joint.axes.size() != 1) continue;
      source.joints.joints.push_back(entry.name);
      source.names.push_back(joint.name);
    }
    for (const std::string& topic : robot_topics(robot, "joint_states")) {
      const auto before = old.find(topic);
      const LazyPublisher made = before != old.end() ? before->second
                                                     : LazyPublisher::of<sensor_msgs::JointState>(
                                                           node_, topic, kJointQueue);
      publishers_.emplace(topic, made);
      source.publishers.push_back(made);
    }
    sources_.push_back(std::move(source));
  }
}

void JointStates::publish(const sim::Snapshot& snapshot) {
  const Nanoseconds slot = snapshot.time / kJointPeriod;
  if (slot == slot_) return;
  slot_ = slot;
  for (const Source& source : sources_) {
    const auto message = [&] {
      sensor_msgs::JointState states;
      states.header.stamp = to_ros(snapshot.time);
      states.name = source.names;
      for (const physics::JointState& joint : simulation_.observe(source.joints).joints) {
        states.position.push_back(joint.position);
        states.velocity.push_back(joint.velocity);
        states.effort.push_back(joint.effort);
      }
      return states;
    };
    for (const LazyPublisher& made : source.publishers) made.publish(message);
  }
}

}  // namespace angen::node
