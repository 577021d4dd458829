// Plug-ins in files of Python, which a file registers while it is loaded.
#include <filesystem>

#include "core/text.h"
#include "py/bindings.h"

namespace angen::py {

namespace {

using Plugins = std::vector<std::shared_ptr<const Plugin>>;

// A file that is being loaded, and its registered classes. One may load another.
struct Loading {
  std::string file;
  Plugins plugins;
  Loading* outer;

  std::string name() const { return std::filesystem::path(file).filename(); }
};
thread_local Loading* loading = nullptr;

// Runs the file as a module of its own, which its classes find in sys.modules.
void run_file(const std::string& file) {
  const std::filesystem::path path(file);
  const pyb::module_ sys = pyb::module_::import("sys");
  const std::string folder = path.parent_path();
  if (!pyb::cast<bool>(sys.attr("path").attr("__contains__")(folder))) {
    sys.attr("path").attr("append")(folder);
  }
  const pyb::object module = pyb::module_::import("types").attr("ModuleType")(path.stem().string());
  module.attr("__file__") = file;
  const pyb::module_ builtins = pyb::module_::import("builtins");
  const pyb::object opened = builtins.attr("open")(file, "rb");
  const pyb::object text = opened.attr("read")();
  opened.attr("close")();
  const pyb::object code = builtins.attr("compile")(text, file, "exec");
  sys.attr("modules")[pyb::str(path.stem().string())] = module;
  builtins.attr("exec")(code, module.attr("__dict__"));
}

Plugins load_script(const std::string& file) {
  const pyb::gil_scoped_acquire gil;
  for (const Loading* each = loading; each != nullptr; each = each->outer) {
    if (each->file == file) {
      throw Error(file +
                  " requests itself while it is loaded; put statements of the program only below "
                  "if __name__ == '__main__':");
    }
  }
  Loading now{file, {}, loading};
  loading = &now;
  std::string problem;
  try {
    run_file(file);
  } catch (pyb::error_already_set& error) {
    problem = one_line(error);
    if (error.matches(PyExc_KeyboardInterrupt)) PyErr_SetInterrupt();  // one_line would consume it
  }
  loading = now.outer;
  if (!problem.empty()) throw Error(problem);
  return now.plugins;
}

}  // namespace

void bind_scripts(pyb::module_& module, std::vector<std::shared_ptr<Catalog>> catalogs) {
  module.def(
      "register",
      [catalogs = std::move(catalogs)](const std::string& filename, const std::string& kind,
                                       const pyb::object& type) {
        const pyb::object base = pyb::module_::import("angen").attr("Sensor");
        const bool sensor = PyObject_IsSubclass(type.ptr(), base.ptr()) == 1;
        const std::shared_ptr<const Plugin> plugin =
            sensor ? python_sensor(kind, type) : python_device(kind, type);
        if (loading == nullptr) {
          for (const auto& catalog : catalogs) catalog->add(filename, plugin);
        } else if (filename == loading->name()) {
          loading->plugins.push_back(plugin);
        } else {
          throw Error("registers " + printable(filename, 100) + " and is the file " +
                      loading->name() + "; both must be the same");
        }
      },
      pyb::arg("filename"), pyb::arg("kind"), pyb::arg("type"),
      "Makes a Python subclass of Sensor or Device a plug-in: <plugin filename=\"FILENAME\">.");
  set_script_loader(&load_script);
}

}  // namespace angen::py
