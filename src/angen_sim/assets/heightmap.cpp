#include "assets/heightmap.h"

#include <filesystem>
#include <map>
#include <mutex>

#include "assets/png.h"
#include "core/text.h"

namespace angen::load {
namespace {

HeightGrid read_grid(const std::string& path, const Vec3& size, const Source& at) {
  const GrayImage image = read_png(path, "heightmap", 2, at);
  HeightGrid grid{image.width, image.height, size.x(), size.y(), {}};
  grid.heights.reserve(image.values.size());
  for (const double value : image.values) {
    grid.heights.push_back(static_cast<float>(size.z() * value));
  }
  return grid;
}

}  // namespace

std::shared_ptr<const HeightGrid> read_heightmap(const std::string& path, const Vec3& size,
                                                 const Source& at) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const HeightGrid>> kept;
  std::error_code failed;
  const auto changed = std::filesystem::last_write_time(path, failed).time_since_epoch().count();
  std::string key = path + "|" + std::to_string(changed);
  for (int i = 0; i < 3; ++i) key += "|" + number_text(size[i]);
  const std::lock_guard<std::mutex> lock(mutex);
  for (auto it = kept.begin(); it != kept.end();) {
    it = it->second.expired() ? kept.erase(it) : std::next(it);
  }
  if (auto found = kept[key].lock()) return found;
  auto grid = std::make_shared<const HeightGrid>(read_grid(path, size, at));
  kept[key] = grid;
  return grid;
}

}  // namespace angen::load
