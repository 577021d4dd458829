#pragma once

#include <angen_msgs/Entity.h>

#include <string>
#include <vector>

#include "desc/world.h"
#include "ros/topics.h"
#include "sim/snapshot.h"

namespace angen::node {

/// Models, devices and sensors, ordered by name, then kind; of one kind unless `kind` is empty.
std::vector<angen_msgs::Entity> entities(const sim::Snapshot& snapshot,
                                         const std::vector<desc::Plugin>& world_plugins,
                                         Topics topics, const std::string& kind);

/// The present pose of a model's frame, by its first link: every model has one.
Pose model_pose(const sim::Snapshot& snapshot, std::uint32_t first_link);

}  // namespace angen::node
