#include "people/storey_maps.h"

#include <algorithm>

namespace angen::people {

namespace {

constexpr std::size_t kKept = 4;
constexpr std::size_t kMaxKeptCells = 500'000;  // 7 MB

}  // namespace

std::shared_ptr<const FloorMap> StoreyMaps::find(const View& view, const Vec3& feet,
                                                 const FloorMap::Vec2& to) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = std::find_if(kept_.begin(), kept_.end(),
                                  [&](const auto& map) { return map->serves(view, feet, to); });
  if (found != kept_.end()) {
    std::rotate(found, found + 1, kept_.end());
    return kept_.back();
  }
  auto map = std::make_shared<const FloorMap>(view, feet, to);
  if (map->cells() > kMaxKeptCells) return map;
  if (kept_.size() == kKept) kept_.erase(kept_.begin());
  kept_.push_back(map);
  return map;
}

}  // namespace angen::people
