#pragma once

#include <string>

#include "core/photometry.h"

namespace angen::load {

/// The intensities in a file of IES LM-63 (1986 to 2019). Throws Error with file and line for
/// one that is broken, or has an unsupported feature: a tilt, types A and B.
Photometry photometry_of(const std::string& text, const std::string& file);

}  // namespace angen::load
