#pragma once

#include <visualization_msgs/Marker.h>

#include <vector>

#include "core/home.h"
#include "desc/world.h"

namespace angen::node {

/// A rectangle that is lit: a corner, its edges, and the direction that it faces.
struct LitFace {
  Vec3 corner;
  Vec3 u;
  Vec3 v;
  Vec3 normal;
  double alpha;  // under endless light
};

/// The floor of a room, as the rectangle around it, and then each wall.
std::vector<LitFace> lit_faces(const Room& room);

/// The light of a lamp at `point`, in the world, on faces of its room: a translucent skin over
/// them, stronger where more direct light falls. Level 0..1. Its origin is `point`.
visualization_msgs::Marker draw_glow(const Room& room, const std::vector<LitFace>& faces,
                                     const Vec3& point, const desc::Light& light, double level);

}  // namespace angen::node
