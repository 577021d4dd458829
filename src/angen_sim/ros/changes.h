#pragma once

#include <cstdint>
#include <vector>

#include "sim/snapshot.h"

namespace angen::node {

/// The numbers of one structure's entries in another structure.
struct Numbers {
  static constexpr std::uint32_t kNone = UINT32_MAX;

  std::vector<std::uint32_t> before;  // each present entry's old index; kNone: it is new
  std::vector<std::uint32_t> after;   // each old entry's present index; kNone: it was removed
};

/// Entries added and removed between two structures. Others keep their order. A model's entries are
/// added and removed with it, also where its description was replaced. A light of the world's
/// own that has changed is another.
struct Changes {
  Numbers models;
  Numbers links;
  Numbers devices;
  Numbers sensors;
  Numbers lights;
};

/// `before` may be null: then everything is new.
Changes changes_between(const sim::Structure* before, const sim::Structure& now);

}  // namespace angen::node
