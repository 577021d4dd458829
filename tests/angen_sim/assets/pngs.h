#pragma once

#include <png.h>

#include <cstdio>

#include "angen_sim/sdf/texts.h"

namespace angen::load {

struct PngFormat {
  int bits = 8;
  int type = PNG_COLOR_TYPE_GRAY;
  enum class Gamma { kNone, kGama, kSrgb } gamma = Gamma::kNone;
};

/// Writes a PNG as it is: `samples` of all pixels from the top, in the format's bits.
inline std::string png(const Folder& folder, unsigned width, unsigned height,
                       const std::vector<unsigned>& samples, const PngFormat& format = {}) {
  const std::string path = folder.write("h.png", "");
  std::vector<png_byte> bytes;
  for (const unsigned sample : samples) {
    if (format.bits == 16) bytes.push_back(static_cast<png_byte>(sample / 256));
    bytes.push_back(static_cast<png_byte>(sample % 256));
  }
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(writer);
  png_init_io(writer, file);
  png_set_IHDR(writer, info, width, height, format.bits, format.type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (format.gamma == PngFormat::Gamma::kGama) png_set_gAMA(writer, info, 1.0 / 2.2);
  if (format.gamma == PngFormat::Gamma::kSrgb)
    png_set_sRGB(writer, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(writer, info);
  for (unsigned row = 0; row < height; ++row) {
    png_write_row(writer, bytes.data() + row * (bytes.size() / height));
  }
  png_write_end(writer, info);
  png_destroy_write_struct(&writer, &info);
  std::fclose(file);
  return path;
}

}  // namespace angen::load
