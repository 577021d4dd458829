#pragma once

#include <string>

#include "core/pose.h"

namespace angen::node::gazebo {

/// The text of a request to spawn, as load::model() and load::light() take it.
struct ModelText {
  std::string xml;
  Pose own_pose;  // the pose in the text, before the request's
};

/// True where the root element is URDF's, false if it is SDF's. Throws Error for any other.
bool is_urdf(const std::string& xml);

/// Takes an element out of the <world> around it, and gives each <plugin> without a
/// <robotNamespace> this one, unless it is "" or "/". Throws Error for text that is not XML.
ModelText model_text(const std::string& xml, const std::string& robot_namespace);

}  // namespace angen::node::gazebo
