#pragma once

#include <string>
#include <vector>

#include "plugin/library.h"

namespace angen {

/// The catalog as JSON, a list with one object for each kind. `angen plugins --json` prints it, and
/// the build writes it beside each plug-in library, as libNAME.json. Infinite limits are null.
std::string to_json(const std::vector<PluginDoc>& plugins);

}  // namespace angen
