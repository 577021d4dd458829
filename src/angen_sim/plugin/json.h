#pragma once

#include <string>
#include <vector>

#include "plugin/library.h"

namespace angen {

/// The catalog as JSON, a list with one object for each kind: what `angen plugins --json` prints
/// and what stands beside a plug-in library as libNAME.json. Infinite limits are null.
std::string to_json(const std::vector<PluginDoc>& plugins);

}  // namespace angen
