#include "assets/png.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>

#include "fuzz/targets.h"

namespace angen::fuzz {
namespace {

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = at; i < at + 4; ++i) {
    number = number << 8U | static_cast<unsigned char>(bytes[i]);
  }
  return number;
}

// libpng drops a chunk whose checksum is wrong before it reads it.
std::string with_png_checksums(std::string bytes) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kHead = 8;  // length and type
  for (std::size_t at = kSignature; at + kHead + 4 <= bytes.size();) {
    const std::size_t length = number_at(bytes, at);
    if (length > bytes.size() - at - kHead - 4) break;
    const auto* type = reinterpret_cast<const Bytef*>(bytes.data()) + at + 4;
    const uLong sum = crc32(0, type, static_cast<uInt>(length + 4));
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[at + kHead + length + i] = static_cast<char>(sum >> (24 - 8 * i));
    }
    at += kHead + length + 4;
  }
  return bytes;
}

}  // namespace

void png(const std::string& input) {
  static const MemoryFile file(".png");
  file.write(with_png_checksums(input));
  answered([&] {
    const load::GrayImage image = load::read_png(file.path(), "picture", 1, {});
    require(image.values.size() == std::size_t{image.width} * image.height, "a value a pixel");
    require(std::all_of(image.values.begin(), image.values.end(),
                        [](double value) { return value >= 0.0 && value <= 1.0; }),
            "values are from 0 to 1");
  });
}

}  // namespace angen::fuzz
