#include <zlib.h>

#include <algorithm>
#include <cstdint>

#include "assets/collada.h"
#include "assets/picture.h"
#include "fuzz/targets.h"

// The pictures that angen_mesh reads, in this process: to start one for each would take most of the
// time, and libFuzzer does not see which code of it an input reaches.
namespace angen::fuzz {
namespace {

constexpr std::size_t kSignature = 8;  // bytes of a PNG, before its chunks
constexpr std::size_t kHead = 8;       // of a chunk: length and type

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = at; i < at + 4; ++i) {
    number = number << 8U | static_cast<unsigned char>(bytes[i]);
  }
  return number;
}

// Sides below 256 pixels: larger ones only take more time.
std::string small_png(std::string bytes) {
  constexpr std::size_t kWidth = kSignature + kHead;
  if (bytes.size() < kWidth + 8) return bytes;
  std::fill_n(bytes.begin() + kWidth, 3, '\0');
  std::fill_n(bytes.begin() + kWidth + 4, 3, '\0');
  return bytes;
}

std::string small_jpeg(std::string bytes) {
  for (std::size_t at = 0; at + 9 <= bytes.size(); ++at) {
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (bytes[at] != '\xFF' || marker < 0xC0 || marker > 0xCF) continue;  // not a frame's header
    bytes[at + 5] = bytes[at + 7] = '\0';
  }
  return bytes;
}

// libpng drops a chunk whose checksum is wrong before it reads it.
std::string with_png_checksums(std::string bytes) {
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

void texture(const std::string& bytes) {
  answered<load::Rejected>([&] {
    const Texture made = load::picture_of(bytes);
    require(made.bytes.size() == std::size_t{3} * made.width * made.height, "three bytes a pixel");
  });
}

}  // namespace

void png(const std::string& input) {
  const std::string bytes = with_png_checksums(small_png(input));
  answered<load::Rejected>([&] {
    const load::GrayImage image = load::gray_picture_of(bytes, 1);
    require(image.values.size() == std::size_t{image.width} * image.height, "a value a pixel");
    require(std::all_of(image.values.begin(), image.values.end(),
                        [](double value) { return value >= 0.0 && value <= 1.0; }),
            "values are from 0 to 1");
  });
  texture(bytes);
}

void jpeg(const std::string& input) { texture(small_jpeg(input)); }

}  // namespace angen::fuzz
