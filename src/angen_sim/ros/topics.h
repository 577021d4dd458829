#pragma once

#include <string>
#include <vector>

#include "ros/formats.h"
#include "ros/frames.h"
#include "sim/snapshot.h"

namespace angen::node {

/// Where one message of a sensor is heard; `robot` is the one that carries it, or null. The first
/// is the one to name.
std::vector<std::string> sensor_topics(const sim::SensorEntry& sensor, const Format& format,
                                       const Robot* robot);

}  // namespace angen::node
