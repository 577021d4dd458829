#pragma once

#include <visualization_msgs/Marker.h>

#include "core/home.h"
#include "desc/world.h"

namespace angen::node {

/// The light of a lamp at `point`, in the world, on the floor and walls of its room: a translucent
/// skin over them, stronger where more direct light falls. Level 0..1. Its origin is `point`.
visualization_msgs::Marker draw_glow(const Room& room, const Vec3& point, const desc::Light& light,
                                     double level);

}  // namespace angen::node
