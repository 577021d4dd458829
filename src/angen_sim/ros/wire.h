#pragma once

#include <string>

namespace angen::node {

/// `text` as a ROS graph name: characters other than letters, digits, `_` and `/` become `_`, and a
/// name that would start with neither a letter nor `/` gets an `a`.
std::string graph_name(const std::string& text);

/// Where a sensor or device is heard: the topic that its SDF asks for (relative to the node's
/// namespace, as with Gazebo's plug-ins), or /angen/KIND/NAME.
std::string topic_of(const std::string& kind, const std::string& name,
                     const std::string& asked = "");

}  // namespace angen::node
