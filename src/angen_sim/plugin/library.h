#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plugin/plugin.h"

namespace angen {

/// The plug-ins of each requested library, or file of Python, by file name. Searches
/// ANGEN_PLUGIN_PATH, GAZEBO_PLUGIN_PATH, in `lib` of each catkin workspace that is sourced
/// (CMAKE_PREFIX_PATH), then beside Angen's own libraries; a library of that name that has no
/// Angen plug-in (Gazebo's own, say) is skipped. Libraries in other folders are not loaded, nor
/// are those that register no plug-in: loading runs code. A library stays loaded until the process
/// ends: objects that it made may outlive the catalog. Calls from several threads are safe.
class Catalog {
 public:
  Catalog();
  /// With `any_path` it takes a path to any folder.
  explicit Catalog(bool any_path);
  ~Catalog();
  Catalog(const Catalog&) = delete;
  Catalog& operator=(const Catalog&) = delete;

  /// All plug-ins in `filename` (a name to look for, or a path with a '/'); throws Error when it is
  /// not found, does not load, or has none.
  const std::vector<std::shared_ptr<const Plugin>>& library(const std::string& filename);

  /// Adds plug-ins that live in this process (a Python class) under a file name of their own.
  void add(const std::string& filename, std::shared_ptr<const Plugin> plugin);

  /// The plug-ins of Angen's own libraries, which have a catalog file beside them.
  std::vector<std::shared_ptr<const Plugin>> own();

  /// The file name by which a plug-in's library was requested.
  std::string library_of(const Plugin& plugin);

  /// File names of every library on the path that has Angen plug-ins, sorted. Loads none of them.
  std::vector<std::string> available();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The path of a library on the plug-in path, empty if there is none of that name; of a path,
/// where its folder is on it.
std::string find_library(const std::string& filename);

/// The plug-ins that a file of Python registers; throws Error with file and line.
using ScriptLoader = std::vector<std::shared_ptr<const Plugin>> (*)(const std::string& file);

/// Sets the loader of files that end in `.py`. Python's module `angen` does; in a program that is
/// not Python, the catalog loads libangen_script.so at the first such file, which starts Python.
void set_script_loader(ScriptLoader loader);

struct PluginDoc {
  std::string library;
  Kind kind;
  bool is_device = false;
  std::vector<ParamDoc> params;
};

/// Every plug-in on the path with its parameters, read by configuring one of each on nothing. A
/// library that does not load has an entry whose kind has no name and the reason as its doc.
std::vector<PluginDoc> describe(Catalog& catalog);

/// Describes one library; throws Error if it does not load. `library` in the result is
/// the file's name without its folder.
std::vector<PluginDoc> describe(Catalog& catalog, const std::string& library);

}  // namespace angen
