#pragma once

#include <visualization_msgs/Marker.h>

#include "desc/world.h"
#include "rviz/rooms.h"

namespace angen::node {

/// The light of a lamp at `point`, in the world, on the floor and walls of its room: a translucent
/// skin over them, stronger where more direct light falls. Level 0..1. Its frame is at `point`,
/// turned as the room.
visualization_msgs::Marker draw_glow(const Room& room, const Vec3& point, const desc::Light& light,
                                     double level);

}  // namespace angen::node
