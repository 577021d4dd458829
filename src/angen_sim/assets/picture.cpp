#include "assets/picture.h"

#include <jpeglib.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <string_view>

#include "assets/collada.h"
#include "assets/converter.h"

namespace angen::load {

namespace {

constexpr std::uint32_t kMaxSide = 16'384;  // side of a file; larger ones are rejected

void check_size(std::uint64_t width, std::uint64_t height, unsigned least, unsigned most) {
  if (std::min(width, height) < least || std::max(width, height) > most) {
    throw Rejected("is " + std::to_string(width) + " by " + std::to_string(height) +
                   " pixels; give " + std::to_string(least) + " to " + std::to_string(most) +
                   " a side");
  }
}

// libjpeg's way back from an error is not to come back.
[[noreturn]] void fail(j_common_ptr jpeg) {
  std::array<char, JMSG_LENGTH_MAX> message{};
  jpeg->err->format_message(jpeg, message.data());
  throw Rejected("is damaged: " + std::string(message.data()));
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
  check_size(jpeg.image_width, jpeg.image_height, 1, kMaxSide);
  if (jpeg.num_components > 3) throw Rejected("is a JPEG of four colors; save it as RGB");
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

// Each pixel is the mean of the light of the pixels that it replaces.
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

// libpng reports errors by longjmp: no function between setjmp and the error may own anything.
struct PngReader {
  std::string_view left;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string problem = "it is not a PNG";

  explicit PngReader(const std::string& bytes) : left(bytes) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &PngReader::fail, &PngReader::ignore);
    if (png != nullptr) info = png_create_info_struct(png);
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  static void fail(png_structp png, png_const_charp message) {
    static_cast<PngReader*>(png_get_error_ptr(png))->problem = message;
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}
  static void read(png_structp png, png_bytep to, std::size_t count) {
    std::string_view& left = static_cast<PngReader*>(png_get_io_ptr(png))->left;
    if (count > left.size()) png_error(png, "Read Error");  // libpng's words for a file
    std::memcpy(to, left.data(), count);
    left.remove_prefix(count);
  }

  // Palettes and fewer than 8 bits become 8 bits; transparency is dropped. Colors are those of
  // sRGB, in 8 bits; grays keep their values.
  bool read_header(bool colors) {
    if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_read_fn(png, this, &PngReader::read);
    // Texts and profiles change no sample, and libpng allocates as much memory as their length
    // claims.
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    if (colors) {
      png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT,
                                  reinterpret_cast<png_const_bytep>("gAMA\0sRGB"), 2);
      png_set_gamma(png, PNG_DEFAULT_sRGB, PNG_DEFAULT_sRGB);
      png_set_scale_16(png);
      png_set_gray_to_rgb(png);
    }
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

// A picture's samples, row by row, after its header was read.
std::vector<png_byte> samples_of(PngReader& reader) {
  const std::size_t stride = png_get_rowbytes(reader.png, reader.info);
  std::vector<png_byte> samples(stride * png_get_image_height(reader.png, reader.info));
  std::vector<png_bytep> rows;
  for (std::size_t at = 0; at < samples.size(); at += stride) rows.push_back(&samples[at]);
  if (!reader.read_rows(rows.data())) throw Rejected("is damaged: " + reader.problem);
  return samples;
}

Texture png_picture(const std::string& bytes) {
  PngReader reader(bytes);
  if (!reader.read_header(true)) throw Rejected("is damaged: " + reader.problem);
  Texture made{png_get_image_width(reader.png, reader.info),
               png_get_image_height(reader.png, reader.info),
               {}};
  check_size(made.width, made.height, 1, kMaxSide);
  made.bytes = samples_of(reader);
  return made;
}

}  // namespace

GrayImage gray_picture_of(const std::string& bytes, unsigned least) {
  PngReader reader(bytes);
  if (!reader.read_header(false)) {
    throw Rejected("cannot be read: " + reader.problem + "; give a grayscale PNG of 8 or 16 bits");
  }
  GrayImage image;
  image.width = png_get_image_width(reader.png, reader.info);
  image.height = png_get_image_height(reader.png, reader.info);
  check_size(image.width, image.height, least, kMaxPngSide);
  const std::vector<png_byte> raw = samples_of(reader);
  // One sample a pixel, or three of a color image: then their mean.
  const std::size_t samples = png_get_channels(reader.png, reader.info);
  const bool wide = png_get_bit_depth(reader.png, reader.info) == 16;
  image.values.reserve(std::size_t{image.width} * image.height);
  for (const png_byte* at = raw.data(); at < raw.data() + raw.size();) {
    double sum = 0.0;
    for (std::size_t i = 0; i < samples; ++i, at += wide ? 2 : 1) {
      sum += wide ? (at[0] * 256 + at[1]) / 65535.0 : at[0] / 255.0;
    }
    image.values.push_back(sum / static_cast<double>(samples));
  }
  return image;
}

Texture picture_of(const std::string& bytes) {
  const bool png = bytes.compare(0, 4, "\x89PNG") == 0;
  if (!png && bytes.compare(0, 2, "\xFF\xD8") != 0) {
    throw Rejected("is of an unknown kind; known are PNG and JPEG");
  }
  Texture made = png ? png_picture(bytes) : jpeg_picture(bytes);
  const std::uint32_t width = std::min(made.width, kMaxTextureSide);
  const std::uint32_t height = std::min(made.height, kMaxTextureSide);
  return width == made.width && height == made.height ? made : shrunk(made, width, height);
}

}  // namespace angen::load
