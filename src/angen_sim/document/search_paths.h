#pragma once

#include <string>
#include <vector>

namespace angen::load {

/// Elements that Angen does not know, and errors in parts that the rest does not need, are errors
/// (kStrict) or warnings (kTolerant). kAuto: a world without any of Angen's plug-ins is tolerant, a
/// model strict.
enum class Strictness { kStrict, kTolerant, kAuto };

/// The folders in which model:// and file:// are searched, in order; documents may name no files
/// elsewhere.
struct SearchPaths {
  std::vector<std::string> models;
  std::vector<std::string> resources;
  std::string beside{};                 // the one of `models` that came with a world
  std::vector<std::string> packages{};  // folders with ROS packages, whose files may be named
  std::vector<std::string> files{};     // may be named, too
  bool allow_any = false;               // documents may name every file
  Strictness strictness = Strictness::kStrict;

  /// ANGEN_MODEL_PATH, GAZEBO_MODEL_PATH, `beside`, the installed worlds/models;
  /// GAZEBO_RESOURCE_PATH for resources; ROS_PACKAGE_PATH; ANGEN_ALLOW_PATHS=true;
  /// ANGEN_STRICT=true|false, kAuto without it.
  static SearchPaths from_environment(const std::string& beside = "");
};

}  // namespace angen::load
