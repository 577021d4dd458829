#pragma once

#include <string>

#include "sim/simulation.h"

namespace angen::node {

/// Exit code (EX_TEMPFAIL of sysexits.h) of a node that ends because the ROS master was started
/// again: its world is saved, and a new node may continue it.
constexpr int kRescued = 75;

/// rescue.world in state_folder(), rescue_house1.world for a node in the namespace /house1.
std::string default_rescue_path();

/// Writes the world as it is now to `path`, all of it or nothing, for this user alone. The thread
/// that ticks. Throws Error.
void rescue(sim::Simulation& simulation, const std::string& path);

}  // namespace angen::node
