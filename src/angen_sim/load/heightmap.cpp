#include "load/geometry.h"
#include "load/png.h"

namespace angen::load {

std::shared_ptr<const TriangleMesh> read_heightmap(const std::string& path, const Vec3& size,
                                                   const Source& at) {
  const GrayImage heights = read_png(path, "heightmap", 2, at);
  const unsigned width = heights.width;
  const unsigned height = heights.height;
  auto mesh = std::make_shared<TriangleMesh>();
  for (unsigned row = 0; row < height; ++row) {
    for (unsigned column = 0; column < width; ++column) {
      const double x = size.x() * (static_cast<double>(column) / (width - 1) - 0.5);
      const double y = size.y() * (0.5 - static_cast<double>(row) / (height - 1));
      const double z = size.z() * heights.values[row * width + column];
      mesh->vertices.emplace_back(static_cast<float>(x), static_cast<float>(y),
                                  static_cast<float>(z));
    }
  }
  for (unsigned row = 0; row + 1 < height; ++row) {
    for (unsigned column = 0; column + 1 < width; ++column) {
      const std::uint32_t a = row * width + column;
      const std::uint32_t b = a + 1;
      const std::uint32_t c = a + width;
      const std::uint32_t d = c + 1;
      mesh->triangles.push_back({a, c, b});
      mesh->triangles.push_back({b, c, d});
    }
  }
  return mesh;
}

}  // namespace angen::load
