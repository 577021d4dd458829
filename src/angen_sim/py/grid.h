#pragma once

#include <pybind11/pybind11.h>

#include "py/world.h"

namespace angen::py {

/// Rays, rasters, and the storey at a height.
void bind_grid(pybind11::module_& module, pybind11::class_<World>& world);

}  // namespace angen::py
