#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace angen {

/// The folders that plug-in libraries are searched in, in order: ANGEN_PLUGIN_PATH,
/// GAZEBO_PLUGIN_PATH, `lib` of each catkin workspace that is sourced (CMAKE_PREFIX_PATH), and the
/// folder of Angen's own libraries.
std::vector<std::filesystem::path> plugin_path();

/// Loads a library of that file name from this path; it stays loaded. Returns why it does not
/// load, "" if it does.
std::string load_library(const std::string& filename);

/// The folder of Angen's own libraries, with symbolic links resolved.
std::filesystem::path own_folder();

/// The entries of an environment variable such as PATH.
std::vector<std::string> entries_of(const char* variable);

/// Whether documents may name files and plug-in libraries anywhere: ANGEN_ALLOW_PATHS is true or 1.
bool allow_paths();

}  // namespace angen
