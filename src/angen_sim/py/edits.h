#pragma once

#include <pybind11/pybind11.h>

#include "py/world.h"

namespace angen::py {

/// The methods that read and change the state of models.
void bind_edits(pybind11::class_<World>& world);

}  // namespace angen::py
