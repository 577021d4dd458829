#pragma once

#include <string>
#include <vector>

#include "core/diagnostics.h"

namespace angen::load {

/// Samples as the file holds them, row by row from the image's top: gray values from 0 to 1, the
/// mean of a color image's. They are quantities: gAMA, sRGB and iCCP chunks do not change them.
struct GrayImage {
  unsigned width = 0;
  unsigned height = 0;
  std::vector<double> values;
};

constexpr unsigned kMaxPngSide = 2049;

/// A PNG of `least` to kMaxPngSide pixels a side; `what` names it in messages. Throws Error at
/// `at`.
GrayImage read_png(const std::string& path, const std::string& what, unsigned least,
                   const Source& at);

}  // namespace angen::load
