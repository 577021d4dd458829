#pragma once

#include <string>

#include "core/names.h"
#include "robots/base.h"

namespace angen::robots {

/// The name of a device that serves a part of a model.
inline std::string part_name(const std::string& model, const std::string& part) {
  return part.empty() ? model : model + "_" + part;
}

}  // namespace angen::robots
