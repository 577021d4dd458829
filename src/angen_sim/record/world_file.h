#pragma once

#include <string>

#include "desc/world.h"
#include "sim/snapshot.h"

namespace angen::record {

/// The world as SDF that loads again in the state of `snapshot`: models that are there now, where
/// they are, joints as they stand, sensors that were attached.
std::string world_file(const desc::World& settings, const sim::Snapshot& snapshot);

}  // namespace angen::record
