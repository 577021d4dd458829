#pragma once

#include <string>
#include <vector>

namespace angen::load {

/// The dialect of documents that do not say theirs (document/dialect.h): ours or Gazebo's. kAuto:
/// that of a world without any of Angen's plug-ins is Gazebo's, a model's ours.
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
  /// GAZEBO_RESOURCE_PATH for resources; ROS_PACKAGE_PATH; ANGEN_ALLOW_PATHS=true;
  /// ANGEN_STRICT=true|false, kAuto without it.
  static SearchPaths from_environment(const std::string& beside = "");
};

}  // namespace angen::load
