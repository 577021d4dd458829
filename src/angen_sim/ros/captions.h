#pragma once

#include <visualization_msgs/Marker.h>

#include <string>

#include "plugin/reading.h"

/// Readings as a few words over their sensors, for those that have no rays to draw, and a battery's
/// charge over its model.
namespace angen::node {

/// Whether readings of this kind are shown as words.
bool has_caption(const std::string& kind);

/// The words, red while what the sensor looks for is there; with neither id nor place. Nothing to
/// read where there is no reading yet.
visualization_msgs::Marker draw_caption(const std::string& kind, const Reading* reading);

}  // namespace angen::node
