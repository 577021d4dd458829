#include "node/commands.h"

#include <angen_msgs/Event.h>
#include <ros/console.h>
#include <ros/exceptions.h>

#include <iterator>
#include <set>
#include <utility>

#include "node/text.h"
#include "ros/ros_kind.h"
#include "ros/wire.h"

namespace angen::node {

namespace {

struct CommandTopic {
  std::string topic;
  std::string kind;  // kind of the device that it commands, and its name
  std::string name;
  Subscribe subscribe;
};

// The topics on which devices take messages of their own, by the rules of their kinds.
std::vector<CommandTopic> command_topics(const sim::Structure& structure,
                                         const std::vector<Robot>& robots) {
  std::vector<CommandTopic> topics;
  for (const sim::DeviceEntry& device : structure.devices) {
    for (const CommandTopicRule& rule : ros_kind(device).commands) {
      if (!rule.topics) continue;
      for (const std::string& topic : rule.topics(structure, device)) {
        topics.push_back({topic, device.kind, device.name, rule.subscribe});
      }
    }
  }
  for (const Robot& robot : robots) {
    const sim::DeviceEntry& device = structure.devices[robot.device];
    for (const std::string& topic : robot.command_topics) {
      topics.push_back(
          {topic, device.kind, device.name, ros_kind(device).commands.front().subscribe});
    }
  }
  return topics;
}

constexpr std::uint32_t kCommandQueue =
    1000;  // commands are never dropped for another of the same moment

std::vector<std::string> names_of(const sim::Structure& structure, const std::string& kind) {
  std::vector<std::string> names;
  for (const sim::DeviceEntry& device : structure.devices) {
    if (device.kind == kind) names.push_back(device.name);
  }
  return names;
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
  any_ = node_.subscribe<angen_msgs::Command>("angen/command", kCommandQueue, any);
  const boost::function<void(const angen_msgs::Event::ConstPtr&)> note =
      [this](const angen_msgs::Event::ConstPtr& event) {
        inbox_.note({event->source, event->kind, event->event, event->detail});
      };
  notes_ = node_.subscribe<angen_msgs::Event>("angen/events/add", kCommandQueue, note);
}

void Commands::receive(const Plugin& plugin, const std::string& text) {
  sim::Action action = topic_action(plugin.kind(), text);
  if (auto* reject = std::get_if<sim::Reject>(&action)) {
    const std::vector<std::string> names =
        names_of(*inbox_.simulation().snapshot()->structure, plugin.kind().name);
    reject->reason += "; names are " + (names.empty() ? "none" : join_names(names));
  }
  inbox_.post(std::move(action));
}

void Commands::subscribe(const std::shared_ptr<const Plugin>& plugin) {
  const Kind& kind = plugin->kind();
  if (kind.command_topic().empty() || kinds_.count(kind.name) > 0) return;
  const boost::function<void(const std_msgs::String::ConstPtr&)> received =
      [this, plugin](const std_msgs::String::ConstPtr& text) { receive(*plugin, text->data); };
  const std::string topic = in_namespace(kind.command_topic());
  try {
    node_.resolveName(topic);  // throws
    kinds_[kind.name] = Registered<ros::Subscriber>([node = node_, topic, received]() mutable {
      return node.subscribe<std_msgs::String>(topic, kCommandQueue, received);
    });
  } catch (const ros::Exception& error) {
    ROS_WARN("no commands to a %s on %s: %s", kind.name.c_str(), topic.c_str(), error.what());
  }
}

void Commands::on_kinds(const sim::Structure& structure) {
  std::vector<std::shared_ptr<const Plugin>> plugins = always_;
  plugins.insert(plugins.end(), structure.device_plugins.begin(), structure.device_plugins.end());
  std::set<std::string> kinds_in_use;
  for (const std::shared_ptr<const Plugin>& plugin : plugins) {
    subscribe(plugin);
    kinds_in_use.insert(plugin->kind().name);
  }
  for (auto kind = kinds_.begin(); kind != kinds_.end();) {
    kind = kinds_in_use.count(kind->first) > 0 ? std::next(kind) : kinds_.erase(kind);
  }
}

void Commands::on_structure(const sim::Structure& structure, const std::vector<Robot>& robots) {
  on_kinds(structure);
  decltype(own_) kept;
  for (const CommandTopic& each : command_topics(structure, robots)) {
    const std::pair<std::string, std::string> key{each.topic, each.kind + "/" + each.name};
    if (const auto old = own_.find(key); old != own_.end()) {
      kept.insert(*old);
      continue;
    }
    try {
      node_.resolveName(each.topic);  // throws
      const auto take = [this, each](Command command) {
        inbox_.post(sim::ToDevice{each.kind, each.name, std::move(command)});
      };
      kept[key] = Registered<ros::Subscriber>(
          [node = node_, each, take]() mutable { return each.subscribe(node, each.topic, take); });
    } catch (const ros::Exception& error) {
      ROS_WARN("%s takes no commands on %s: %s", each.name.c_str(), each.topic.c_str(),
               error.what());
    }
  }
  own_ = std::move(kept);
}

}  // namespace angen::node
