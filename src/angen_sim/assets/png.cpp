#include "assets/png.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>

namespace angen::load {

namespace {

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
    // Texts and profiles change no sample, and libpng takes what memory their length claims.
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
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

}  // namespace

GrayImage read_png(const std::string& path, const std::string& what, unsigned least,
                   const Source& at) {
  PngReader reader(path);
  if (!reader.read_header()) {
    throw Error(at, what + " " + path + " cannot be read: " + reader.problem +
                        "; give a grayscale PNG of 8 or 16 bits");
  }
  GrayImage image;
  image.width = png_get_image_width(reader.png, reader.info);
  image.height = png_get_image_height(reader.png, reader.info);
  if (std::min(image.width, image.height) < least ||
      std::max(image.width, image.height) > kMaxPngSide) {
    throw Error(at, what + " " + path + " is " + std::to_string(image.width) + " by " +
                        std::to_string(image.height) + " pixels; give " + std::to_string(least) +
                        " to " + std::to_string(kMaxPngSide) + " a side");
  }
  const std::size_t stride = png_get_rowbytes(reader.png, reader.info);
  std::vector<png_byte> bytes(stride * image.height);
  std::vector<png_bytep> rows;
  for (unsigned row = 0; row < image.height; ++row) rows.push_back(&bytes[row * stride]);
  if (!reader.read_rows(rows.data())) {
    throw Error(at, what + " " + path + " is damaged: " + reader.problem);
  }
  // One sample a pixel, or three of a color image: then their mean.
  const std::size_t samples = png_get_channels(reader.png, reader.info);
  const bool wide = png_get_bit_depth(reader.png, reader.info) == 16;
  image.values.reserve(std::size_t{image.width} * image.height);
  for (const png_bytep row : rows) {
    for (std::size_t column = 0; column < image.width; ++column) {
      double sum = 0.0;
      for (std::size_t i = column * samples; i < (column + 1) * samples; ++i) {
        sum += wide ? (row[2 * i] * 256 + row[2 * i + 1]) / 65535.0 : row[i] / 255.0;
      }
      image.values.push_back(sum / static_cast<double>(samples));
    }
  }
  return image;
}

}  // namespace angen::load
