#pragma once

#include <cstdint>
#include <vector>

#include "sim/snapshot.h"

namespace angen::node {

/// How the entries of one list of a structure were numbered in another.
struct Numbers {
  static constexpr std::uint32_t kNone = UINT32_MAX;

  std::vector<std::uint32_t> before;  // of each entry there is now; kNone: it is new
  std::vector<std::uint32_t> after;   // of each entry there was; kNone: it has gone
};

/// What came and went between two structures. Entries that stay keep their order. What a model has
/// goes with it, and comes with it: also where it is described anew. A light of the world's own
/// that has changed is another.
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
