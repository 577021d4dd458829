#include <png.h>

#include "load/geometry.h"

namespace angen::load {

namespace {

constexpr unsigned kMaxSide = 2049;

// 16-bit grey, row by row from the image's top.
std::vector<std::uint16_t> read_grey(const std::string& path, unsigned& width, unsigned& height,
                                     const Source& at) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) {
    throw Error(at,
                "heightmap " + path + " cannot be read: " + image.message + "; give a grey PNG");
  }
  width = image.width;
  height = image.height;
  if (width < 2 || height < 2 || width > kMaxSide || height > kMaxSide) {
    png_image_free(&image);
    throw Error(at, "heightmap " + path + " is " + std::to_string(width) + " by " +
                        std::to_string(height) + " pixels; give 2 to 2049 a side");
  }
  // libpng's 16-bit formats are linear light; 8-bit grey is what the file holds, as it holds it.
  image.format = PNG_FORMAT_GRAY;
  std::vector<png_byte> bytes(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr) == 0) {
    throw Error(at, "heightmap " + path + " is damaged: " + image.message);
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::shared_ptr<const TriangleMesh> read_heightmap(const std::string& path, const Vec3& size,
                                                   const Source& at) {
  unsigned width = 0;
  unsigned height = 0;
  const std::vector<std::uint16_t> grey = read_grey(path, width, height, at);
  auto mesh = std::make_shared<TriangleMesh>();
  for (unsigned row = 0; row < height; ++row) {
    for (unsigned column = 0; column < width; ++column) {
      const double x = size.x() * (static_cast<double>(column) / (width - 1) - 0.5);
      const double y = size.y() * (0.5 - static_cast<double>(row) / (height - 1));
      const double z = size.z() * grey[row * width + column] / 255.0;
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
