#pragma once

#include <string_view>
#include <vector>

#include "people/surroundings.h"
#include "plugin/plugin.h"

namespace angen::people {

/// Another person on the same floor, as one sees it.
struct Other {
  using Vec2 = Surroundings::Vec2;

  std::string_view name;  // until the next step
  Vec3 feet;              // m, world
  Vec2 heading;           // unit, where it faces
  double speed = 0.0;     // m/s
  bool on_way = false;    // it walks, or waits to walk on

  Vec2 at() const { return feet.head<2>(); }
};

/// All of them but the person at `feet` (world, m) itself.
std::vector<Other> others_near(const View& view, const Vec3& feet);

}  // namespace angen::people
