#include "ros/commands.h"

#include <angen_msgs/Event.h>
#include <ros/console.h>
#include <ros/exceptions.h>

#include <iterator>
#include <set>
#include <utility>

#include "ros/text.h"
#include "ros/topics.h"
#include "ros/wire.h"

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

/// A topic of velocities, and the drive that takes them.
struct Steering {
  std::string topic;
  std::string kind;
  std::string name;
  bool sideways = false;  // it takes three numbers
};

// Gazebo's kinds of drives, by the <plugin> that each was made of.
std::vector<Steering> foreign_drives(const sim::Structure& structure) {
  static const std::set<std::string> kinds = {"diff_drive", "skid_steer_drive", "planar_move"};
  std::vector<Steering> found;
  for (const sim::DeviceEntry& device : structure.devices) {
    if (kinds.count(device.kind) == 0) continue;
    for (const desc::Plugin& plugin : structure.models[device.model]->plugins) {
      if (plugin.filename != device.library) continue;
      const Element* given = plugin.element.child("commandTopic");
      const std::string topic = given == nullptr ? "cmd_vel" : given->text;
      found.push_back({graph_name(below_namespace(plugin.element, topic)), device.kind, device.name,
                       device.plugin->kind().value_units.size() == 3});
    }
  }
  return found;
}

std::vector<Steering> all_drives(const sim::Structure& structure,
                                 const std::vector<Robot>& robots) {
  std::vector<Steering> all = foreign_drives(structure);
  for (const Robot& robot : robots) {
    for (const std::string& topic : robot.command_topics) {
      all.push_back({topic, "drive", robot.name, false});
    }
  }
  return all;
}

}  // namespace

Commands::Commands(ros::NodeHandle& node, Inbox& inbox,
                   std::vector<std::shared_ptr<const Plugin>> plugins)
    : node_(node), inbox_(inbox), always_(std::move(plugins)) {
  for (const auto& plugin : always_) subscribe(plugin);
  const boost::function<void(const angen_msgs::Command::ConstPtr&)> any =
      [this](const angen_msgs::Command::ConstPtr& command) {
        inbox_.post(any_action(command->target, command->text));
      };
  any_ = node_.subscribe<angen_msgs::Command>("/angen/command", kCommandQueue, any);
  const boost::function<void(const angen_msgs::Event::ConstPtr&)> note =
      [this](const angen_msgs::Event::ConstPtr& event) {
        inbox_.note({event->source, event->kind, event->event, event->detail});
      };
  notes_ = node_.subscribe<angen_msgs::Event>("/angen/events/add", kCommandQueue, note);
}

void Commands::receive(const Plugin& plugin, const std::string& text) {
  const std::string& kind = plugin.kind().name;
  const std::vector<std::string> names = names_of(*inbox_.simulation().snapshot()->structure, kind);
  sim::Action action = topic_action(plugin.kind(), text, names);
  if (auto* reject = std::get_if<sim::Reject>(&action)) {
    reject->reason += "; names are " + (names.empty() ? "none" : join_names(names));
  }
  inbox_.post(std::move(action));
}

void Commands::subscribe(const std::shared_ptr<const Plugin>& plugin) {
  const Kind& kind = plugin->kind();
  if (kind.command_topic.empty() || kinds_.count(kind.name) > 0) return;
  const boost::function<void(const std_msgs::String::ConstPtr&)> received =
      [this, plugin](const std_msgs::String::ConstPtr& text) { receive(*plugin, text->data); };
  try {
    kinds_[kind.name] =
        node_.subscribe<std_msgs::String>(kind.command_topic, kCommandQueue, received);
  } catch (const ros::Exception& error) {
    ROS_WARN("no commands to a %s on %s: %s", kind.name.c_str(), kind.command_topic.c_str(),
             error.what());
  }
}

void Commands::on_kinds(const sim::Structure& structure) {
  std::vector<std::shared_ptr<const Plugin>> plugins = always_;
  plugins.insert(plugins.end(), structure.device_plugins.begin(), structure.device_plugins.end());
  std::set<std::string> wanted;
  for (const std::shared_ptr<const Plugin>& plugin : plugins) {
    subscribe(plugin);
    wanted.insert(plugin->kind().name);
  }
  for (auto kind = kinds_.begin(); kind != kinds_.end();) {
    kind = wanted.count(kind->first) > 0 ? std::next(kind) : kinds_.erase(kind);
  }
}

void Commands::on_structure(const sim::Structure& structure, const std::vector<Robot>& robots) {
  on_kinds(structure);
  decltype(drives_) kept;
  for (const Steering& drive : all_drives(structure, robots)) {
    const std::pair<std::string, std::string> key{drive.topic, drive.kind + "/" + drive.name};
    if (const auto old = drives_.find(key); old != drives_.end()) {
      kept.insert(*old);
      continue;
    }
    const boost::function<void(const geometry_msgs::Twist::ConstPtr&)> received =
        [this, drive](const geometry_msgs::Twist::ConstPtr& twist) {
          std::vector<double> values = {twist->linear.x, twist->angular.z};
          if (drive.sideways) values.insert(values.begin() + 1, twist->linear.y);
          inbox_.post(sim::ToDevice{drive.kind, drive.name, {"", std::move(values), "", 0.0}});
        };
    try {
      kept[key] = node_.subscribe<geometry_msgs::Twist>(drive.topic, kDriveQueue, received);
    } catch (const ros::Exception& error) {
      ROS_WARN("%s takes no commands on %s: %s", drive.name.c_str(), drive.topic.c_str(),
               error.what());
    }
  }
  drives_ = std::move(kept);
}

}  // namespace angen::node
