#include "core/plugin_path.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace angen {

namespace fs = std::filesystem;

namespace {

// The folder of this library, which contains all libraries of Angen.
fs::path own_folder() {
  static const char here = 0;
  Dl_info info;
  if (dladdr(&here, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code ignored;
  return fs::weakly_canonical(info.dli_fname, ignored).parent_path();
}

}  // namespace

std::vector<std::string> entries_of(const char* variable) {
  const char* value = std::getenv(variable);
  std::istringstream list(value == nullptr ? "" : value);
  std::vector<std::string> entries;
  for (std::string entry; std::getline(list, entry, ':');) {
    if (!entry.empty()) entries.push_back(entry);
  }
  return entries;
}

std::vector<fs::path> plugin_path() {
  std::vector<fs::path> folders;
  const auto add = [&](const fs::path& folder) {
    if (std::find(folders.begin(), folders.end(), folder) == folders.end()) {
      folders.push_back(folder);
    }
  };
  for (const char* variable : {"ANGEN_PLUGIN_PATH", "GAZEBO_PLUGIN_PATH"}) {
    for (const std::string& entry : entries_of(variable)) add(entry);
  }
  for (const std::string& workspace : entries_of("CMAKE_PREFIX_PATH")) {
    add(fs::path(workspace) / "lib");
  }
  add(own_folder());
  return folders;
}

}  // namespace angen
