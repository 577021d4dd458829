#include "ros/commands.h"

#include <ros/console.h>
#include <ros/exceptions.h>

#include "ros/text.h"

namespace angen::node {
namespace {

constexpr std::uint32_t kCommandQueue =
    1000;  // commands are never dropped for another of the same moment
constexpr std::uint32_t kDriveQueue = 10;

std::vector<std::string> names_of(const sim::Structure& structure, const std::string& kind) {
  std::vector<std::string> names;
  for (const sim::DeviceEntry& device : structure.devices) {
    if (device.kind == kind) names.push_back(device.name);
  }
  return names;
}

}  // namespace

Commands::Commands(ros::NodeHandle& node, Inbox& inbox) : node_(node), inbox_(inbox) {
  using Text = const std_msgs::String::ConstPtr&;
  const auto listen = [this](const std::string& topic, auto make) {
    const boost::function<void(Text)> heard = [this, make](Text text) {
      sim::Action action = make(text->data);
      if (auto* reject = std::get_if<sim::Reject>(&action)) add_known_names(*reject);
      inbox_.post(std::move(action));
    };
    subscribers_.push_back(node_.subscribe<std_msgs::String>(topic, kCommandQueue, heard));
  };
  for (const auto& [kind, source] : {std::pair("door", "Door_controller"),
                                     {"window", "Window_controller"},
                                     {"cabinet", "Cabinet_controller"}}) {
    listen(std::string("/gazebo/") + source, [kind = kind, source = source](const std::string& t) {
      return door_action(t, kind, source);
    });
  }
  listen("/gazebo/Light_controller", &lamp_action);
  listen("/gazebo/Elevator_controller", [this](const std::string& text) {
    return elevator_action(text, names_of(*inbox_.simulation().snapshot()->structure, "elevator"));
  });
  const boost::function<void(const angen_msgs::Command::ConstPtr&)> any =
      [this](const angen_msgs::Command::ConstPtr& command) {
        inbox_.post(any_action(command->target, command->text));
      };
  subscribers_.push_back(
      node_.subscribe<angen_msgs::Command>("/angen/command", kCommandQueue, any));
}

void Commands::add_known_names(sim::Reject& reject) const {
  const std::vector<std::string> known =
      names_of(*inbox_.simulation().snapshot()->structure, reject.kind);
  reject.reason += "; known names are " + join_names(known);
}

void Commands::follow(const std::vector<Robot>& robots) {
  decltype(drives_) kept;
  for (const Robot& robot : robots) {
    for (const std::string& topic : robot.command_topics) {
      const auto old = drives_.find({topic, robot.name});
      if (old != drives_.end()) {
        kept.insert(*old);
        continue;
      }
      const boost::function<void(const geometry_msgs::Twist::ConstPtr&)> heard =
          [this, name = robot.name](const geometry_msgs::Twist::ConstPtr& twist) {
            drive(name, *twist);
          };
      try {
        kept[{topic, robot.name}] =
            node_.subscribe<geometry_msgs::Twist>(topic, kDriveQueue, heard);
      } catch (const ros::Exception& error) {
        ROS_WARN("%s does not hear %s: %s", robot.name.c_str(), topic.c_str(), error.what());
      }
    }
  }
  drives_ = std::move(kept);
}

void Commands::drive(const std::string& robot, const geometry_msgs::Twist& twist) {
  inbox_.post(sim::ToDevice{"drive", robot, {"", {twist.linear.x, twist.angular.z}}});
}

}  // namespace angen::node
