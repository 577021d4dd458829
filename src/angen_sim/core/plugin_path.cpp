#include "core/plugin_path.h"

#include <dlfcn.h>

#include <cstdlib>
#include <sstream>

#include "core/lists.h"

namespace angen {

namespace fs = std::filesystem;

fs::path own_folder() {
  static const char here = 0;
  Dl_info info;
  if (dladdr(&here, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code ignored;
  return fs::weakly_canonical(info.dli_fname, ignored).parent_path();
}

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
    if (!is_in(folder, folders)) folders.push_back(folder);
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

std::string load_library(const std::string& filename) {
  for (const fs::path& folder : plugin_path()) {
    const std::string file = folder / filename;
    std::error_code missing;
    if (!fs::is_regular_file(file, missing)) continue;
    const void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    return library != nullptr ? "" : file + " does not load: " + dlerror();
  }
  return filename + " is not found on the plug-in path";
}

bool allow_paths() {
  const char* value = std::getenv("ANGEN_ALLOW_PATHS");
  const std::string text = value == nullptr ? "" : value;
  return text == "true" || text == "True" || text == "1";
}

}  // namespace angen
