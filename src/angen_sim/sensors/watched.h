#pragma once

#include <vector>

#include "plugin/params.h"
#include "plugin/plugin.h"

namespace angen::sensors {

/// The collisions that <contact><collision> names, of the sensor's own link. Throws Error if it
/// names none or an unknown one; `who` is the sensor in that message, "a contact sensor".
std::vector<ContactRef> read_watched(Params& params, Wiring& wiring, const char* who);

}  // namespace angen::sensors
