#pragma once

#include <memory>
#include <string>

#include "py/convert.h"

namespace angen::py {

/// A plug-in whose instances are made by calling a Python class.
std::shared_ptr<const Plugin> python_sensor(const std::string& kind, pyb::object type);
std::shared_ptr<const Plugin> python_device(const std::string& kind, pyb::object type);

/// Binds the arguments of their methods, Params, Wiring, View, Outputs, and the bases of classes.
void bind_plugin_types(pyb::module_& module);

}  // namespace angen::py
