#pragma once

#include <pybind11/pybind11.h>

#include "core/home.h"

namespace angen::py {

/// As docs/home.md lists it.
pybind11::dict home_dict(const Home& home);

}  // namespace angen::py
