#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace angen {

/// The folders that plug-in libraries are searched in, in order: ANGEN_PLUGIN_PATH,
/// GAZEBO_PLUGIN_PATH, `lib` of each catkin workspace that is sourced (CMAKE_PREFIX_PATH), and the
/// folder of Angen's own libraries.
std::vector<std::filesystem::path> plugin_path();

/// The entries of an environment variable such as PATH.
std::vector<std::string> entries_of(const char* variable);

}  // namespace angen
