#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plugin/library.h"
#include "py/convert.h"

namespace angen::py {

/// A plug-in whose instances are made by calling a Python class.
std::shared_ptr<const Plugin> python_sensor(const std::string& kind, pyb::object type);
std::shared_ptr<const Plugin> python_device(const std::string& kind, pyb::object type);

/// Binds register(FILENAME, KIND, CLASS). It adds to `catalogs`, or to the plug-ins of a file that
/// is being loaded: from here on, files of Python on the plug-in path are loaded.
void bind_scripts(pyb::module_& module, std::vector<std::shared_ptr<Catalog>> catalogs);

/// Binds the arguments of their methods, Params, Wiring, View, Outputs, and the bases of classes.
void bind_plugin_types(pyb::module_& module);

}  // namespace angen::py
