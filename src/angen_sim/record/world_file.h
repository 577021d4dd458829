#pragma once

#include <string>

#include "desc/world.h"
#include "sim/saved.h"

namespace angen::record {

/// The world as SDF that loads again in that state: models that are there now, where they are,
/// joints as they are, devices with the parameters with which they go on, sensors that were
/// attached.
std::string world_file(const desc::World& settings, const sim::SavedState& state);

}  // namespace angen::record
