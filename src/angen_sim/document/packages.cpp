#include "document/packages.h"

#include <algorithm>
#include <filesystem>

#include "document/xml.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

constexpr int kDeepest = 5;  // below a folder of ROS_PACKAGE_PATH

// A folder called share has its packages side by side, among much else.
int depth_below(const fs::path& root) { return root.filename() == "share" ? 1 : kDeepest; }

// "a:b" with ${prefix} for the package's folder, as Gazebo's own path plug-in reads it.
void add_folders(const std::string* list, const std::string& prefix, std::vector<std::string>& to) {
  if (list == nullptr) return;
  for (std::size_t at = 0; at <= list->size();) {
    const std::size_t end = std::min(list->find(':', at), list->size());
    std::string folder = list->substr(at, end - at);
    at = end + 1;
    constexpr char kPrefix[] = "${prefix}";
    const std::size_t found = folder.find(kPrefix);
    if (found != std::string::npos) folder.replace(found, sizeof kPrefix - 1, prefix);
    if (!folder.empty()) to.push_back(fs::path(folder).lexically_normal().string());
  }
}

}  // namespace

Packages::Packages(const std::vector<std::string>& roots) {
  for (const std::string& root : roots) search(root, depth_below(root));
}

std::optional<std::string> Packages::folder(const std::string& package) const {
  const auto found = folders_.find(package);
  return found == folders_.end() ? std::nullopt : std::make_optional(found->second);
}

void Packages::search(const std::string& folder, int depth) {
  std::error_code failed;
  if (fs::exists(fs::path(folder) / "CATKIN_IGNORE", failed)) return;
  if (fs::exists(fs::path(folder) / "package.xml", failed)) {
    add(folder);
    return;
  }
  if (depth == 0) return;
  std::vector<std::string> below;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
    const std::string name = entry.path().filename().string();
    if (name.front() != '.' && entry.is_directory(failed)) below.push_back(entry.path().string());
  }
  std::sort(below.begin(), below.end());
  for (const std::string& each : below) search(each, depth - 1);
}

void Packages::add(const std::string& folder) {
  const std::string file = (fs::path(folder) / "package.xml").string();
  std::string name = fs::path(folder).filename().string();
  try {
    const Element package = parse_xml(read_file(file), file);
    if (const Element* given = package.child("name")) name = given->text;
    for (const Element& exported : package.children) {
      if (exported.name != "export") continue;
      for (const Element& each : exported.children) {
        add_folders(each.attribute("gazebo_model_path"), folder, models_);
        add_folders(each.attribute("gazebo_media_path"), folder, media_);
      }
    }
  } catch (const Error&) {
    // One whose package.xml cannot be read is known by its folder.
  }
  folders_.emplace(name, folder);
}

}  // namespace angen::load
