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
    for (std::uint32_t i = 0; i < structure.joints.size(); ++i) {
      const sim::JointEntry& entry = structure.joints[i];
      if (entry.model != robot.model) continue;
      const desc::Joint& joint = structure.models[entry.model]->joints[entry.joint];
      if (joint.axes.size() != 1) continue;
      source.joints.push_back(i);
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
  const double since = to_seconds(snapshot.time - std::exchange(time_, snapshot.time));
  for (Source& source : sources_) {
    const std::vector<double> before = std::exchange(source.before, {});
    for (const std::uint32_t joint : source.joints) {
      source.before.push_back(snapshot.joint_positions[joint]);
    }
    for (const LazyPublisher& made : source.publishers) {
      made.publish([&] {
        sensor_msgs::JointState message;
        message.header.stamp = to_ros(snapshot.time);
        message.name = source.names;
        message.position = source.before;
        for (std::size_t i = 0; i < source.before.size(); ++i) {
          const bool known = before.size() == source.before.size() && since > 0.0;
          message.velocity.push_back(known ? (source.before[i] - before[i]) / since : 0.0);
        }
        return message;
      });
    }
  }
}

}  // namespace angen::node
