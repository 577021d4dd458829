#include "ros/extension.h"

#include <ros/console.h>

#include "core/plugin_path.h"

namespace angen::node {

namespace {

MakeExtension registered_extension = nullptr;  // by the library that was loaded last

}  // namespace

ExtensionRegistration::ExtensionRegistration(MakeExtension make) { registered_extension = make; }

std::unique_ptr<Extension> make_extension(const std::string& library, const ExtensionParts& parts) {
  const std::string problem = load_library(library);
  if (problem.empty() && registered_extension != nullptr) return registered_extension(parts);
  ROS_WARN("%s: its services and topics are missing; build its package, or source its workspace",
           problem.c_str());
  return nullptr;
}

}  // namespace angen::node
