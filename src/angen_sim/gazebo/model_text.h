#pragma once

#include <string>

#include "core/pose.h"

namespace angen::node::gazebo {

/// The text of a request to spawn, as load::model() and load::light() take it.
struct ModelText {
  std::string xml;
  Pose own_pose;  // that the text gives the model, before the request's
};

/// True where the root element is URDF's, false where it is SDF's. Throws Error for any other.
bool is_urdf(const std::string& xml);

/// Takes an element out of the <world> around it, and gives each <plugin> without a
/// <robotNamespace> this one, unless it is "" or "/". Throws Error for text that is not XML.
ModelText model_text(const std::string& xml, const std::string& robot_namespace);

}  // namespace angen::node::gazebo
