#pragma once

#include <cstdint>

namespace angen {

/// A slot and how often it was used before: an id of something deleted never names its successor.
template <class Tag>
struct Id {
  std::uint32_t index = UINT32_MAX;
  std::uint32_t generation = 0;

  bool valid() const { return index != UINT32_MAX; }
  bool operator==(const Id& o) const { return index == o.index && generation == o.generation; }
  bool operator!=(const Id& o) const { return !(*this == o); }
  bool operator<(const Id& o) const {
    return index != o.index ? index < o.index : generation < o.generation;
  }
};

}  // namespace angen
