#pragma once

#include <string>
#include <vector>

#include "core/lists.h"

namespace angen {

/// Properties of a link that its plug-in moves as a living body.
struct Anatomy {
  using Names = std::vector<std::string>;

  bool upright = false;  // never tilts: rotates about world z only
  double side_stiffness =
      0.0;                   // N/m, of its sides against what a joint to the world moves; 0: rigid
  std::vector<Names> limbs;  // each: visuals that move as one in the link's frame
  std::vector<Names> postures;  // each: collisions that touch and are hit by rays only in it; the
                                // link starts in the first

  /// The number of the list that contains the name; -1: none.
  static int find(const std::vector<Names>& lists, const std::string& name) {
    for (std::size_t i = 0; i < lists.size(); ++i) {
      if (is_in(name, lists[i])) return static_cast<int>(i);
    }
    return -1;
  }
};

}  // namespace angen
