#pragma once

#include <string>

#include "robots/base.h"

namespace angen::robots {

/// A link's or joint's name within its model, of "model::name" or "name".
inline std::string local_name(const std::string& model, const std::string& name) {
  const std::string prefix = model + "::";
  return name.rfind(prefix, 0) == 0 ? name.substr(prefix.size()) : name;
}

/// The name of a device that serves a part of a model.
inline std::string part_name(const std::string& model, const std::string& part) {
  return part.empty() ? model : model + "_" + part;
}

}  // namespace angen::robots
