#pragma once

#include <pybind11/pybind11.h>

namespace angen::py {

/// Lets inspect.signature() and editors see the parameters of all functions of the module.
void sign(const pybind11::module_& module);

}  // namespace angen::py
