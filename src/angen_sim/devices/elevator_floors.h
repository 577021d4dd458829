#pragma once

#include <string>
#include <vector>

#include "plugin/params.h"
#include "plugin/plugin.h"
#include "plugin/wiring.h"

namespace angen::devices {

constexpr double kLevelWithin = 0.005;  // m from a floor, where an elevator is level with it
constexpr double kUnlimited = 1e9;      // m: a joint with a longer travel has no end

/// Heights of an elevator's floors over floor 0, in m, from below: each <stop>; or <floors> of them
/// each <floor_height>; or the storeys of the world within the travel of its joint; or else evenly
/// over that. Throws Error if neither is known.
std::vector<double> read_floors(Params& params, const Wiring& wiring, const JointLimits& limits,
                                const std::string& joint);

}  // namespace angen::devices
