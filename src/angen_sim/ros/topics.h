#pragma once

#include <string>
#include <vector>

#include "ros/robots.h"
#include "ros/ros_kind.h"
#include "sim/snapshot.h"

namespace angen::node {

/// Topics on which sensors and devices publish.
enum class Topics {
  kSensor,  // each has its own
  kKind,    // one carries all of a kind that has an array; robots' have their own all the same
};

/// Throws Error for a word that is neither "sensor" nor "kind".
Topics topics_named(const std::string& word);

/// The topics of one message of a sensor that has topics of its own, none if it is
/// switched off; `robot` is the one that carries it, or null. The first is the one to name.
std::vector<std::string> sensor_topics(const sim::SensorEntry& sensor, const Format& format,
                                       const Robot* robot);

/// The <robotNamespace> of a plug-in, or null.
const Element* namespace_of(const Element& plugin);

/// A topic of a plug-in as Gazebo has it: one that does not start with / is below its
/// <robotNamespace>.
std::string below_namespace(const Element& plugin, const std::string& topic);

/// Whether that message is published on the topic of its kind.
bool is_on_topic_of_kind(Topics topics, const Format& format, const Robot* robot);
std::string kind_topic(const std::string& kind);

}  // namespace angen::node
