#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "people/floor_map.h"

namespace angen::people {

/// The maps of storeys, for all people: most goals are places on the same storeys, whose static
/// shapes stay.
class StoreyMaps {
 public:
  /// The map around both places, for a person whose feet are at `feet` (world, m).
  std::shared_ptr<const FloorMap> find(const View& view, const Vec3& feet,
                                       const FloorMap::Vec2& to);

 private:
  std::mutex mutex_;                                   // worlds may run in several threads
  std::vector<std::shared_ptr<const FloorMap>> kept_;  // the last used one at the end
};

}  // namespace angen::people
