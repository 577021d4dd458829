#pragma once

#include <pybind11/pybind11.h>

#include "core/home.h"

namespace angen::py {

/// The home in the form that docs/home.md lists.
pybind11::dict home_dict(const Home& home);

}  // namespace angen::py
