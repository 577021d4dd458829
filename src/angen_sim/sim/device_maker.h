#pragma once

#include <string>
#include <vector>

#include "sim/instance.h"

namespace angen::sim {

/// Makes the devices of a model by the plug-ins of model and world, and the sensors that a
/// model's own plug-in is, and lamps of lights that none of them has, if the light has a level or
/// the model's customs say so. Throws Error for one that is wrong, unless they set it aside.
void make_devices(LiveModel& live, const std::vector<desc::Plugin>& world_plugins, Catalog& catalog,
                  std::vector<std::string>& warnings);

/// The lamp of a light without a plug-in, for that light as `live` describes it now: at the level
/// that it has, or at that of the start.
void remake_own_lamp(LiveModel& live, DeviceInstance& lamp, bool keep_level, Catalog& catalog,
                     std::vector<std::string>& warnings);

}  // namespace angen::sim
