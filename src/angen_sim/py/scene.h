#pragma once

#include <pybind11/pybind11.h>

#include "sim/snapshot.h"

namespace angen::py {

/// What viewers draw, as angen_msgs/Scene has it.
pybind11::dict scene_dict(const sim::Snapshot& snapshot);

}  // namespace angen::py
