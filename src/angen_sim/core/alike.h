#pragma once

#include <string>
#include <vector>

#include "core/diagnostics.h"

namespace angen {

/// Messages about one file that differ in their lines, in quoted names and in numbers alone are one
/// from the fourth on: the first, with their number, the last line and the other names, at most
/// ten. Keeps the order.
std::vector<Diagnostic> merge_alike(const std::vector<Diagnostic>& all);
/// merge_alike() for texts that begin with FILE:LINE.
std::vector<std::string> merge_alike(const std::vector<std::string>& all);

}  // namespace angen
