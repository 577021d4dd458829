#pragma once

#include <set>
#include <string>
#include <vector>

#include "document/search_paths.h"

namespace angen::load {

/// The files that a document may name: those of the model and resource paths, of packages on
/// ROS_PACKAGE_PATH, and in its own folder, wherever symbolic links lead. A folder of a path, or
/// an entry of it, may itself be a link.
class AllowedFiles {
 public:
  explicit AllowedFiles(const SearchPaths& paths) : paths_(paths) {}

  /// `document` is the file that names `path`; one that does not exist has no folder.
  bool holds(const std::string& path, const std::string& document);

 private:
  void resolve_paths();
  void add_beside();
  void add_linked(const std::string& folder, bool only_models);

  const SearchPaths& paths_;
  bool resolved_ = false;
  std::vector<std::string> folders_;   // real paths
  std::vector<std::string> packages_;  // only files in a package are permitted of these
  std::set<std::string> files_;        // real paths
};

}  // namespace angen::load
