#include "ros/taken_topics.h"

#include <ros/names.h>
#include <ros/publication.h>
#include <ros/this_node.h>
#include <ros/topic_manager.h>

#include <map>
#include <memory>

#include "core/diagnostics.h"
#include "core/lists.h"
#include "core/text.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

/// Empty if the library does not load or has no sensor: the world reports it when it is built.
std::string kind_of(const std::string& library, Catalog& catalog) {
  try {
    for (const auto& plugin : catalog.library(library)) {
      if (plugin->makes_sensors()) return plugin->kind().name;
    }
  } catch (const Error&) {
    return "";
  }
  return "";
}

/// The node's use of a topic: publication or subscription; empty for a free topic.
std::string carried(const std::string& topic) {
  if (const auto found = ros::TopicManager::instance()->lookupPublication(topic)) {
    return "carries " + found->getDataType();
  }
  ros::V_string subscribed;
  ros::this_node::getSubscribedTopics(subscribed);
  const bool is_input = is_in(topic, subscribed);
  return is_input ? "is one that the node subscribes to" : "";
}

}  // namespace

std::vector<NewSensor> new_sensors(const desc::Model& model) {
  std::vector<NewSensor> sensors;
  for (const desc::Link& link : model.links) {
    for (const desc::Sensor& sensor : link.sensors) {
      sensors.push_back({model.name + "_" + sensor.name, &sensor});
    }
  }
  if (sensors.size() == 1) sensors.front().name = model.name;
  return sensors;
}

void check_topics(const std::vector<NewSensor>& sensors, Catalog& catalog, Topics topics) {
  std::map<std::string, std::string> own;  // topics of these sensors
  for (const NewSensor& sensor : sensors) {
    const desc::Sensor& described = *sensor.described;
    sim::SensorEntry entry;
    entry.kind = kind_of(described.plugin, catalog);
    if (entry.kind.empty()) continue;
    entry.name = sensor.name;
    entry.topic = described.plugin_element.child_text("topicName");
    if (entry.topic.empty()) entry.topic = described.plugin_element.child_text("bumperTopicName");
    entry.desc = std::shared_ptr<const desc::Sensor>(std::shared_ptr<void>(), &described);
    for (const Format& format : ros_kind(entry.kind, described.plugin).formats) {
      if (is_on_topic_of_kind(topics, format, nullptr)) continue;
      for (const std::string& topic : sensor_topics(entry, format, nullptr)) {
        if (topic.front() != '/') continue;
        std::string taken = carried(topic);
        const auto twin = own.emplace(topic, "carries " + format.type).first;
        if (taken.empty()) taken = twin->second;
        if (taken == "carries " + format.type) continue;
        throw Error(described.source, "sensor '" + printable(sensor.name) + "' would publish " +
                                          format.type + " on " + printable(topic, 200) +
                                          ", which " + taken + "; give another <topicName>");
      }
    }
  }
}

}  // namespace angen::node
