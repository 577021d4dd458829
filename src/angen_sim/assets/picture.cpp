#include "assets/picture.h"

#include <jpeglib.h>
#include <png.h>

#include <algorithm>
#include <array>

#include "assets/collada.h"
#include "assets/converter.h"

namespace angen::load {

namespace {

constexpr std::uint32_t kMaxSide = 16'384;  // of a file; larger ones are refused

void check_size(std::uint64_t width, std::uint64_t height) {
  if (width == 0 || height == 0 || std::max(width, height) > kMaxSide) {
    throw Refused("is " + std::to_string(width) + " by " + std::to_string(height) +
                  " pixels; give 1 to " + std::to_string(kMaxSide) + " a side");
  }
}

Texture png_picture(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    throw Refused("is damaged: " + std::string(image.message));
  }
  check_size(image.width, image.height);
  image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) {
    throw Refused("is damaged: " + std::string(image.message));
  }
  Texture made{image.width, image.height, {}};
  made.bytes.reserve(pixels.size() / 4 * 3);
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    made.bytes.insert(made.bytes.end(), pixels.begin() + static_cast<std::ptrdiff_t>(i),
                      pixels.begin() + static_cast<std::ptrdiff_t>(i) + 3);
  }
  return made;
}

// libjpeg's way back from an error is not to come back.
[[noreturn]] void fail(j_common_ptr jpeg) {
  std::array<char, JMSG_LENGTH_MAX> message{};
  jpeg->err->format_message(jpeg, message.data());
  throw Refused("is damaged: " + std::string(message.data()));
}

struct Jpeg : jpeg_decompress_struct {
  Jpeg() : jpeg_decompress_struct{} {
    err = jpeg_std_error(&errors);
    errors.error_exit = fail;
    errors.output_message = [](j_common_ptr) {};
    jpeg_create_decompress(this);
  }
  ~Jpeg() { jpeg_destroy_decompress(this); }
  Jpeg(const Jpeg&) = delete;
  Jpeg& operator=(const Jpeg&) = delete;
  jpeg_error_mgr errors{};
};

Texture jpeg_picture(const std::string& bytes) {
  Jpeg jpeg;
  jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  check_size(jpeg.image_width, jpeg.image_height);
  if (jpeg.num_components > 3) throw Refused("is a JPEG of four colors; save it as RGB");
  jpeg.out_color_space = JCS_RGB;
  jpeg_start_decompress(&jpeg);
  Texture made{jpeg.output_width, jpeg.output_height, {}};
  made.bytes.resize(std::size_t{3} * made.width * made.height);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = &made.bytes[std::size_t{3} * made.width * jpeg.output_scanline];
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
  return made;
}

// Each pixel is the mean of the light of those that it stands for.
Texture shrunk(const Texture& from, std::uint32_t width, std::uint32_t height) {
  Texture made{width, height, {}};
  made.bytes.reserve(std::size_t{3} * width * height);
  const auto first = [](std::uint64_t i, std::uint64_t of, std::uint64_t count) {
    return static_cast<std::size_t>(i * of / count);
  };
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      double sum[3] = {0.0, 0.0, 0.0};
      std::size_t count = 0;
      for (std::size_t r = first(y, from.height, height); r < first(y + 1, from.height, height);
           ++r) {
        for (std::size_t c = first(x, from.width, width); c < first(x + 1, from.width, width);
             ++c, ++count) {
          for (std::size_t k = 0; k < 3; ++k)
            sum[k] += linear(from.bytes[3 * (r * from.width + c) + k]);
        }
      }
      for (const double each : sum) made.bytes.push_back(srgb(each / static_cast<double>(count)));
    }
  }
  return made;
}

}  // namespace

Texture picture_of(const std::string& bytes) {
  const bool png = bytes.compare(0, 4, "\x89PNG") == 0;
  if (!png && bytes.compare(0, 2, "\xFF\xD8") != 0) {
    throw Refused("is of an unknown kind; known are PNG and JPEG");
  }
  Texture made = png ? png_picture(bytes) : jpeg_picture(bytes);
  const std::uint32_t width = std::min(made.width, kMaxTextureSide);
  const std::uint32_t height = std::min(made.height, kMaxTextureSide);
  return width == made.width && height == made.height ? made : shrunk(made, width, height);
}

}  // namespace angen::load
