#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace angen::py {

/// An exception as `file:line: TYPE: text`, where it was raised outside of Python's own libraries.
std::string one_line(const pybind11::error_already_set& error);

}  // namespace angen::py
