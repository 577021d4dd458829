#pragma once

#include <angen_msgs/Scene.h>

#include "sim/snapshot.h"

namespace angen::node {

/// The shapes, lights and fields of sensors of a structure; links are at `poses`.
angen_msgs::Scene scene_message(const sim::Structure& structure,
                                const sim::SharedArray<Pose>& poses);

}  // namespace angen::node
