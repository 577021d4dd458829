#pragma once

#include <set>
#include <string>
#include <vector>

namespace angen::load {

/// The dialect of documents that do not say theirs (document/dialect.h): ours or Gazebo's. kAuto:
/// Gazebo's for a world without any of Angen's plug-ins, ours for a model.
enum class DefaultDialect { kOwn, kGazebo, kAuto };

/// The folders in which model:// and file:// are searched, in order; documents may name no files
/// elsewhere.
struct SearchPaths {
  std::vector<std::string> models;
  std::vector<std::string> resources;
  std::string beside{};                 // the one of `models` that came with a world
  std::vector<std::string> packages{};  // folders with ROS packages, whose files may be named
  std::vector<std::string> files{};     // may be named, too
  bool allow_any = false;               // documents may name every file
  DefaultDialect default_dialect = DefaultDialect::kOwn;

  /// ANGEN_MODEL_PATH, GAZEBO_MODEL_PATH, `beside`, the installed worlds/models;
  /// GAZEBO_RESOURCE_PATH for resources; ROS_PACKAGE_PATH; ANGEN_ALLOW_PATHS=true or `allow_any`;
  /// ANGEN_STRICT=true|false, kAuto without it.
  static SearchPaths from_environment(const std::string& beside = "", bool allow_any = false);
};

/// The folder of models that comes with a world's file.
std::string models_beside(const std::string& world);

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
