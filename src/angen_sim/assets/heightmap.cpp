#include "assets/heightmap.h"

#include <filesystem>

#include "assets/png.h"
#include "core/kept.h"
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
  static Kept<std::string, const HeightGrid> kept;
  std::error_code failed;
  const auto changed = std::filesystem::last_write_time(path, failed).time_since_epoch().count();
  std::string key = path + "|" + std::to_string(changed);
  for (int i = 0; i < 3; ++i) key += "|" + number_text(size[i]);
  return kept.get(key, [&] { return std::make_shared<HeightGrid>(read_grid(path, size, at)); });
}

}  // namespace angen::load
