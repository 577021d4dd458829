#pragma once

#include <string>
#include <vector>

#include "sim/instance.h"

namespace angen::sim {

/// Makes what the plug-ins of the model and of the world make of it: devices, and sensors that a
/// model's own plug-in is. Throws Error for one that is wrong, unless the model is tolerant.
void make_devices(LiveModel& live, const std::vector<desc::Plugin>& world_plugins,
                  const Vec3& gravity, Catalog& catalog, std::vector<std::string>& warnings);

}  // namespace angen::sim
