#pragma once

#include <visualization_msgs/Marker.h>

#include <string>
#include <vector>

#include "core/pose.h"
#include "desc/world.h"
#include "plugin/ray_geometry.h"

/// Descriptions as rviz's markers, with neither id nor place.
namespace angen::node {

/// A marker and its pose on its link.
struct Drawing {
  visualization_msgs::Marker marker;
  Pose offset;
};

/// The markers of a visual: one, three for a capsule, none for an empty shape.
std::vector<Drawing> draw(const desc::Visual& visual);

/// A sphere where a light is, lit or dark. Level 0..1.
visualization_msgs::Marker draw(const desc::Light& light, double level);

/// Lines from the sensor's origin in its own frame, `ranges` long (m); a ray without a range has
/// the sensor's greatest.
visualization_msgs::Marker draw_rays(const RayGeometry& rays, double tilt,
                                     const std::vector<double>& ranges);

/// A file's name as a file:// address.
std::string file_address(const std::string& path);

}  // namespace angen::node
