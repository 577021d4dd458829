#include "ros/topics.h"

#include "core/diagnostics.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

std::string text_of(const sim::SensorEntry& sensor, const std::string& parameter) {
  return sensor.desc ? sensor.desc->plugin_element.child_text(parameter) : "";
}

bool is_off(const sim::SensorEntry& sensor, const std::string& parameter) {
  const std::string text = parameter.empty() ? "" : text_of(sensor, parameter);
  return text == "false" || text == "0";
}

}  // namespace

const Element* namespace_of(const Element& plugin) { return plugin.child("robotNamespace"); }

std::string below_namespace(const Element& plugin, const std::string& topic) {
  const Element* space = namespace_of(plugin);
  const bool is_absolute =
      topic.empty() || topic[0] == '/' || space == nullptr || space->text.empty();
  return is_absolute ? topic : in_namespace(space->text + "/" + topic);
}

std::vector<std::string> sensor_topics(const sim::SensorEntry& sensor, const Format& format,
                                       const Robot* robot) {
  if (is_off(sensor, format.off_switch)) return {};
  if (!format.topic.empty()) return {format.topic};
  std::string requested = sensor.topic;
  if (format.leaf_alone) {
    const std::string leaf = text_of(sensor, format.leaf_parameter);
    requested = leaf.empty() ? format.leaf : leaf;
  } else if (!format.leaf_parameter.empty()) {  // one of several, as Gazebo's cameras name them
    const std::string base = text_of(sensor, "cameraName");
    std::string leaf = text_of(sensor, format.leaf_parameter);
    const bool other = !text_of(sensor, format.other_leaf_with).empty();
    if (leaf.empty()) leaf = other ? format.other_leaf : format.leaf;
    if (leaf.empty()) return {};
    requested = leaf[0] == '/'
                    ? leaf
                    : (base.empty() ? default_topic(sensor.kind, sensor.name) : base) + "/" + leaf;
  }
  if (sensor.desc) requested = below_namespace(sensor.desc->plugin_element, requested);
  if (robot != nullptr && !requested.empty()) return robot_topics(*robot, requested);
  return {topic_of(sensor.kind, sensor.name, requested)};
}

Topics topics_named(const std::string& word) {
  if (word == "sensor") return Topics::kSensor;
  if (word == "kind") return Topics::kKind;
  throw Error("~topics is '" + word + "', must be sensor or kind");
}

bool is_on_topic_of_kind(Topics topics, const Format& format, const Robot* robot) {
  return topics == Topics::kKind && !format.array_type.empty() && robot == nullptr;
}

std::string kind_topic(const std::string& kind) {
  return graph_name(in_namespace("angen/" + kind));
}

}  // namespace angen::node
