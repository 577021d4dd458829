#pragma once

#include <cstdint>

namespace angen {

/// Cells up to this distance from the origin, in cells along each axis, have unique keys.
constexpr int kCellLimit = 1 << 20;

/// A cell of a regular lattice as one number.
inline std::uint64_t cell_key(int x, int y, int z) {
  const auto part = [](int v) { return static_cast<std::uint64_t>(v + kCellLimit) & 0x1fffff; };
  return part(x) << 42 | part(y) << 21 | part(z);
}

}  // namespace angen
