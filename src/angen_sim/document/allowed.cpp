#include "document/allowed.h"

#include <algorithm>
#include <filesystem>

namespace angen::load {

namespace fs = std::filesystem;

namespace {

// Without symbolic links; empty if there is nothing.
std::string real(const fs::path& path) {
  std::error_code failed;
  const fs::path found = fs::canonical(path, failed);
  return failed ? "" : found.string();
}

// Both real.
bool is_within(const std::string& path, const std::string& folder) {
  if (folder.empty()) return false;
  if (folder == "/") return true;
  return path.compare(0, folder.size(), folder) == 0 &&
         (path.size() == folder.size() || path[folder.size()] == '/');
}

bool is_model(const fs::path& folder) {
  std::error_code failed;
  return fs::exists(folder / "model.config", failed) || fs::exists(folder / "model.sdf", failed);
}

// True if the file is in a package below `folder`, one of ROS_PACKAGE_PATH.
bool is_in_package(const std::string& file, const std::string& folder) {
  if (!is_within(file, folder)) return false;
  std::error_code failed;
  for (fs::path at = fs::path(file).parent_path(); is_within(at.string(), folder);
       at = at.parent_path()) {
    if (fs::exists(at / "package.xml", failed)) return true;
    if (at == at.parent_path()) break;
  }
  return false;
}

std::string folder_of(const std::string& document) {
  std::error_code failed;
  if (document.empty() || !fs::is_regular_file(document, failed)) return "";
  return real(fs::absolute(document, failed).parent_path());
}

}  // namespace

void AllowedFiles::add_linked(const std::string& folder, bool only_models) {
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
    if (entry.is_symlink(failed) && (!only_models || is_model(entry.path()))) {
      folders_.push_back(real(entry.path()));
    }
  }
}

// worlds/models beside a world came with the world, maybe from a stranger: links lead from there to
// other models only.
void AllowedFiles::add_beside() {
  const fs::path folder = paths_.beside;
  const std::string found = real(folder);
  if (is_within(found, real(folder.parent_path()))) {
    folders_.push_back(found);
    add_linked(found, true);
    return;
  }
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
    if (is_model(entry.path())) folders_.push_back(real(entry.path()));
  }
}

void AllowedFiles::resolve_paths() {
  if (resolved_) return;
  resolved_ = true;
  for (const std::string& file : paths_.files) files_.insert(real(file));
  std::vector<std::string> given = paths_.models;
  const auto beside = std::find(given.begin(), given.end(), paths_.beside);
  if (beside != given.end()) {
    add_beside();
    given.erase(beside);
  }
  given.insert(given.end(), paths_.resources.begin(), paths_.resources.end());
  for (const std::string& folder : given) {
    folders_.push_back(real(folder));
    add_linked(folder, false);
  }
  for (const std::string& folder : paths_.packages) {
    packages_.push_back(real(folder));
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
      if (entry.is_symlink(failed)) packages_.push_back(real(entry.path()));
    }
  }
}

bool AllowedFiles::holds(const std::string& path, const std::string& document) {
  if (paths_.allow_any) return true;
  const std::string file = real(path);
  if (file.empty()) return false;
  if (is_within(file, folder_of(document))) return true;
  resolve_paths();
  if (files_.count(file) != 0) return true;
  const auto has = [&](const std::string& folder) { return is_within(file, folder); };
  if (std::any_of(folders_.begin(), folders_.end(), has)) return true;
  return std::any_of(packages_.begin(), packages_.end(),
                     [&](const std::string& folder) { return is_in_package(file, folder); });
}

}  // namespace angen::load
