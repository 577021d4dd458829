#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "core/home.h"
#include "plugin/library.h"
#include "py/convert.h"
#include "py/exclusive.h"
#include "py/world.h"
#include "sim/snapshot.h"

namespace pybind11::detail {

template <>
class type_caster<angen::py::World> : public angen::py::ExclusiveCaster<angen::py::World> {};

}  // namespace pybind11::detail

namespace angen::py {

/// The methods that read and change the state of models.
void bind_edits(pybind11::class_<World>& world);

/// The methods that tell where shapes, joints and fields of view are.
void bind_geometry(pybind11::class_<World>& world);

/// Rays, rasters, and the storey at a height.
void bind_grid(pybind11::module_& module, pybind11::class_<World>& world);

/// The home in the form that docs/home.md lists.
pybind11::dict home_dict(const Home& home);

/// Binds Replay. `catalog`: of worlds whose models may name libraries anywhere, or on the plug-in
/// path only.
void bind_replay(pyb::module_& module, std::shared_ptr<Catalog> (*catalog)(bool any_path));

/// What viewers draw, as angen_msgs/Scene has it.
pybind11::dict scene_dict(const sim::Snapshot& snapshot);

/// Lets inspect.signature() and editors see the parameters of all functions of the module.
void sign(const pybind11::module_& module);

/// An exception as `file:line: TYPE: text`, where it was raised outside of Python's own libraries.
std::string one_line(const pybind11::error_already_set& error);

/// A plug-in whose instances are made by calling a Python class.
std::shared_ptr<const Plugin> python_sensor(const std::string& kind, pyb::object type);
std::shared_ptr<const Plugin> python_device(const std::string& kind, pyb::object type);

/// Binds register(FILENAME, KIND, CLASS). It adds to `catalogs`, or to the plug-ins of a file that
/// is being loaded: from here on, files of Python on the plug-in path are loaded.
void bind_scripts(pyb::module_& module, std::vector<std::shared_ptr<Catalog>> catalogs);

/// Binds the arguments of their methods, Params, Wiring, View, Outputs, and the bases of classes.
void bind_plugin_types(pyb::module_& module);

}  // namespace angen::py
