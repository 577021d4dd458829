#pragma once

#include <cstdint>
#include <vector>

#include "core/union_find.h"
#include "physics/contacts.h"
#include "physics/model.h"

namespace angen::physics {

/// Groups of awake bodies that joints or contacts connect: a solver takes a group at once, and it
/// falls asleep at once. Numbers the bodies (`Body::island`).
class Islands {
 public:
  Islands(const std::vector<Body*>& awake, const std::vector<Contacts::Pair>& touching);

  /// The island's number, below the number of bodies.
  std::uint32_t of(const Body& body) const { return groups_.root(body.island); }

 private:
  void join(const Body* a, const Body* b);

  UnionFind groups_;
};

/// Finds the bodies of islands that have too many contacts and joints for dWorldStep, whose time
/// grows with the cube of their number (`Body::iterated`). Returns whether there are any.
bool mark_large_islands(const std::vector<Body*>& awake,
                        const std::vector<Contacts::Pair>& touching);

}  // namespace angen::physics
