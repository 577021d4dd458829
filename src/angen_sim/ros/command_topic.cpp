#include "ros/command_topic.h"

#include "ros/topics.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// Several plug-ins of one library differ by the body that their devices are named after.
bool made_by(const desc::Plugin& plugin, const sim::DeviceEntry& device) {
  if (plugin.filename != device.library) return false;
  const std::string body = plugin.element.child_text("bodyName");
  return body.empty() || ends_with(device.name, "_" + body.substr(body.rfind(':') + 1));
}

}  // namespace

CommandTopicRule::Topics topics_by_parameter(std::string parameter, std::string fallback) {
  return [parameter = std::move(parameter), fallback = std::move(fallback)](
             const sim::Structure& structure, const sim::DeviceEntry& device) {
    std::vector<std::string> topics;
    for (const desc::Plugin& plugin : structure.models[device.model]->plugins) {
      if (!made_by(plugin, device)) continue;
      std::string topic = plugin.element.child_text(parameter);
      if (topic.empty()) topic = fallback;
      if (!topic.empty()) topics.push_back(graph_name(below_namespace(plugin.element, topic)));
    }
    return topics;
  };
}

}  // namespace angen::node
