#pragma once

#include "desc/world.h"

namespace angen::sim {

/// The number of the link's visual that a collision has its surface from (albedo, temperature):
/// that of the same name, or its first; -1 where the link has none.
inline int like_visual(const desc::Link& link, const desc::Collision& collision) {
  for (std::size_t i = 0; i < link.visuals.size(); ++i) {
    if (link.visuals[i].name == collision.name) return static_cast<int>(i);
  }
  return link.visuals.empty() ? -1 : 0;
}

}  // namespace angen::sim
