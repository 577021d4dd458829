#pragma once

#include <pybind11/pybind11.h>

#include "py/world.h"

namespace angen::py {

/// The methods that tell where shapes, joints and fields of view are.
void bind_geometry(pybind11::class_<World>& world);

}  // namespace angen::py
