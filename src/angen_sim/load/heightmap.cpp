#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>

#include "load/geometry.h"

namespace angen::load {

namespace {

constexpr unsigned kMaxSide = 2049;

// Samples as the file holds them, row by row from the image's top. A height is a quantity and not a
// color: gAMA, sRGB and iCCP chunks do not change it.
struct Heights {
  unsigned width = 0;
  unsigned height = 0;
  std::vector<double> values;  // 0..1
};

// libpng reports errors by longjmp: no function between setjmp and the error may own anything.
struct PngReader {
  std::FILE* file = nullptr;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string problem = "it is not a PNG";

  explicit PngReader(const std::string& path) : file(std::fopen(path.c_str(), "rb")) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &PngReader::fail, &PngReader::ignore);
    if (png != nullptr) info = png_create_info_struct(png);
  }
  ~PngReader() {
    png_destroy_read_struct(&png, &info, nullptr);
    if (file != nullptr) std::fclose(file);
  }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  static void fail(png_structp png, png_const_charp message) {
    static_cast<PngReader*>(png_get_error_ptr(png))->problem = message;
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}

  // Palettes and fewer than 8 bits become 8 bits; transparency is dropped.
  bool read_header() {
    if (file == nullptr || info == nullptr || setjmp(png_jmpbuf(png)) != 0) return false;
    png_init_io(png, file);
    png_read_info(png, info);
    png_set_expand(png);
    png_set_strip_alpha(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return true;
  }
  bool read_rows(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_image(png, rows);
    png_read_end(png, nullptr);
    return true;
  }
};

Heights read_heights(const std::string& path, const Source& at) {
  PngReader reader(path);
  if (!reader.read_header()) {
    throw Error(at, "heightmap " + path + " cannot be read: " + reader.problem +
                        "; give a grayscale PNG of 8 or 16 bits");
  }
  Heights heights;
  heights.width = png_get_image_width(reader.png, reader.info);
  heights.height = png_get_image_height(reader.png, reader.info);
  if (std::min(heights.width, heights.height) < 2 ||
      std::max(heights.width, heights.height) > kMaxSide) {
    throw Error(at, "heightmap " + path + " is " + std::to_string(heights.width) + " by " +
                        std::to_string(heights.height) + " pixels; give 2 to 2049 a side");
  }
  const std::size_t stride = png_get_rowbytes(reader.png, reader.info);
  std::vector<png_byte> bytes(stride * heights.height);
  std::vector<png_bytep> rows;
  for (unsigned row = 0; row < heights.height; ++row) rows.push_back(&bytes[row * stride]);
  if (!reader.read_rows(rows.data())) {
    throw Error(at, "heightmap " + path + " is damaged: " + reader.problem);
  }
  // One sample a pixel, or three of a color image: then their mean.
  const std::size_t samples = png_get_channels(reader.png, reader.info);
  const bool wide = png_get_bit_depth(reader.png, reader.info) == 16;
  for (const png_bytep row : rows) {
    for (std::size_t column = 0; column < heights.width; ++column) {
      double sum = 0.0;
      for (std::size_t i = column * samples; i < (column + 1) * samples; ++i) {
        sum += wide ? (row[2 * i] * 256 + row[2 * i + 1]) / 65535.0 : row[i] / 255.0;
      }
      heights.values.push_back(sum / static_cast<double>(samples));
    }
  }
  return heights;
}

}  // namespace

std::shared_ptr<const TriangleMesh> read_heightmap(const std::string& path, const Vec3& size,
                                                   const Source& at) {
  const Heights heights = read_heights(path, at);
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
