#pragma once

#include "sim/instance.h"

namespace angen::sim {

/// Whether the description of the home may change with that model: it says something of it, has a
/// door or elevator, or may be a wall.
bool is_of_home(const LiveModel& live);

/// Whether it gives storeys, or rooms from which they follow.
bool describes_storeys(const desc::Model& model);

}  // namespace angen::sim
