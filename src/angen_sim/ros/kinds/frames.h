#pragma once

#include "ros/robots.h"
#include "ros/ros_kind.h"

namespace angen::node {

/// The frame that the first of these parameters names which is given, or the sensor's name.
inline RosKind::Frame frame_by(std::vector<std::string> parameters) {
  return [parameters = std::move(parameters)](const sim::SensorEntry& sensor) {
    for (const std::string& parameter : parameters) {
      const Element* given = sensor.desc->plugin_element.child(parameter);
      if (given != nullptr) return given->text;
    }
    return sensor.name;
  };
}

/// Messages without a frame, as states of joints are.
inline std::string no_frame(const sim::SensorEntry&) { return ""; }

}  // namespace angen::node
