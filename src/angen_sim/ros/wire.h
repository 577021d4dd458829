#pragma once

#include <string>

namespace angen::node {

constexpr char kWorldFrame[] = "world";

/// `text` as a ROS graph name: a byte that is not a letter, digit, `_` or `/` becomes `_xHH`, its
/// value in hexadecimal, and so does a `_` that would read as the start of one. Different names of
/// entities, which hold no `/`, stay different. A text that would start with neither a letter nor
/// `/` gets an `a`.
std::string graph_name(const std::string& text);

/// NAME or /NAME in the namespace of the node: /NAME, or /house1/NAME of a node in /house1.
std::string in_namespace(const std::string& name);

/// angen/KIND/NAME in the namespace of the node, not yet a graph name.
std::string default_topic(const std::string& kind, const std::string& name);

/// The topic of a sensor or device: the one that its SDF gives (relative to the node's
/// namespace, as with Gazebo's plug-ins), or angen/KIND/NAME.
std::string topic_of(const std::string& kind, const std::string& name,
                     const std::string& requested = "");

}  // namespace angen::node
