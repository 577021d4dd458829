#include "node/command_topics.h"

#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Wrench.h>
#include <std_msgs/Float64.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <map>
#include <utility>

#include "gazebo/joint_control.h"
#include "ros/topics.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

constexpr std::uint32_t kOwnQueue = 10;

template <class Message, Command (*make)(const Message&)>
ros::Subscriber subscribe_as(ros::NodeHandle& node, const std::string& topic,
                             const std::function<void(Command)>& take) {
  const boost::function<void(const boost::shared_ptr<const Message>&)> received =
      [take](const boost::shared_ptr<const Message>& message) { take(make(*message)); };
  return node.subscribe<Message>(topic, kOwnQueue, received);
}

Command of_values(std::vector<double> values) { return {"", std::move(values), "", 0.0}; }

Command of_twist(const geometry_msgs::Twist& twist) {
  return of_values({twist.linear.x, twist.angular.z});
}

Command of_flat_twist(const geometry_msgs::Twist& twist) {
  return of_values({twist.linear.x, twist.linear.y, twist.angular.z});
}

Command of_wrench(const geometry_msgs::Wrench& wrench) {
  return of_values({wrench.force.x, wrench.force.y, wrench.force.z, wrench.torque.x,
                    wrench.torque.y, wrench.torque.z});
}

Command of_number(const std_msgs::Float64& number) { return of_values({number.data}); }

// As joint_pose_trajectory takes it. A point with another number of positions than there are joints
// makes the number of values wrong, and is rejected.
Command of_trajectory(const trajectory_msgs::JointTrajectory& trajectory) {
  Command command = of_values({trajectory.header.stamp.toSec()});
  for (const std::string& joint : trajectory.joint_names) command.text += joint + " ";
  for (const trajectory_msgs::JointTrajectoryPoint& point : trajectory.points) {
    command.values.push_back(point.time_from_start.toSec());
    command.values.insert(command.values.end(), point.positions.begin(), point.positions.end());
  }
  return command;
}

/// How a kind takes messages: on the topic that a parameter of its <plugin> names.
struct Taker {
  std::string parameter;
  std::string fallback;
  Subscribe subscribe;
};

const std::map<std::string, Taker>& takers() {
  static const Subscribe twists = subscribe_as<geometry_msgs::Twist, of_twist>;
  static const std::map<std::string, Taker> all = {
      {"diff_drive", {"commandTopic", "cmd_vel", twists}},
      {"skid_steer_drive", {"commandTopic", "cmd_vel", twists}},
      {"kobuki", {"none", "mobile_base/commands/velocity", twists}},
      {"planar_move",
       {"commandTopic", "cmd_vel", subscribe_as<geometry_msgs::Twist, of_flat_twist>}},
      {"force", {"topicName", "", subscribe_as<geometry_msgs::Wrench, of_wrench>}},
      {"joint_trajectory",
       {"topicName", "set_joint_trajectory",
        subscribe_as<trajectory_msgs::JointTrajectory, of_trajectory>}},
  };
  return all;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// Several plug-ins of one library differ by the body that their devices are named after.
bool made_by(const desc::Plugin& plugin, const sim::DeviceEntry& device) {
  if (plugin.filename != device.library) return false;
  const std::string body = plugin.element.child_text("bodyName");
  return device.kind != "force" || body.empty() ||
         ends_with(device.name, "_" + body.substr(body.rfind(':') + 1));
}

void add_by_parameter(const sim::Structure& structure, const sim::DeviceEntry& device,
                      const Taker& taker, std::vector<CommandTopic>& to) {
  for (const desc::Plugin& plugin : structure.models[device.model]->plugins) {
    if (!made_by(plugin, device)) continue;
    std::string topic = plugin.element.child_text(taker.parameter);
    if (topic.empty()) topic = taker.fallback;
    if (topic.empty()) continue;
    to.push_back({graph_name(below_namespace(plugin.element, topic)), device.kind, device.name,
                  taker.subscribe});
  }
}

// The topics of ros_control's usual controllers, where these do not run.
void add_joint(const sim::Structure& structure, const sim::DeviceEntry& device,
               std::vector<CommandTopic>& to) {
  const desc::Model& model = *structure.models[device.model];
  for (const desc::Plugin& plugin : model.plugins) {
    if (plugin.filename != device.library) continue;
    const std::string space = control_space(plugin.element, model.name);
    for (const ControlledJoint& joint : driven_joints(plugin.element)) {
      if (device.name != model.name + "_" + joint.name) continue;
      const std::string topic = joint.name + "_" + joint.interface + "_controller/command";
      to.push_back({graph_name(space + "/" + topic), device.kind, device.name,
                    subscribe_as<std_msgs::Float64, of_number>});
      return;
    }
  }
}

}  // namespace

std::vector<CommandTopic> command_topics(const sim::Structure& structure,
                                         const std::vector<Robot>& robots) {
  std::vector<CommandTopic> topics;
  for (const sim::DeviceEntry& device : structure.devices) {
    const auto taker = takers().find(device.kind);
    if (taker != takers().end()) add_by_parameter(structure, device, taker->second, topics);
    if (device.kind == "joint_command" && !has_joint_control(device.library)) {
      add_joint(structure, device, topics);
    }
  }
  for (const Robot& robot : robots) {
    for (const std::string& topic : robot.command_topics) {
      topics.push_back({topic, "drive", robot.name, subscribe_as<geometry_msgs::Twist, of_twist>});
    }
  }
  return topics;
}

}  // namespace angen::node
