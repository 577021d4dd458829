#pragma once

#include <angen_msgs/DeleteRequest.h>
#include <angen_msgs/SpawnRequest.h>

#include "load/load.h"
#include "sim/command.h"

namespace angen::node {

/// What a service's request asks for, to be queued; they throw Error for what cannot be.
sim::Action spawn_action(const angen_msgs::SpawnRequest& request, const load::SearchPaths& paths);
sim::Action delete_action(const angen_msgs::DeleteRequest& request);

}  // namespace angen::node
