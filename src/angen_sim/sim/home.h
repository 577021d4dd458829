#pragma once

#include "sim/instance.h"

namespace angen::sim {

/// Whether the description of the home may change with that model: it says something of it, has a
/// door or elevator, or may be a wall.
bool is_of_home(const LiveModel& live);

/// Whether storeys follow from it: it describes them, or rooms, or has walls, a floor or doors.
bool may_have_storeys(const desc::Model& model);

}  // namespace angen::sim
