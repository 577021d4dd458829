#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "assets/mesh.h"
#include "core/files.h"
#include "core/text.h"
#include "document/search.h"
#include "document/xml.h"
#include "sdf/entry.h"
#include "sdf/load.h"

namespace angen::load {

namespace {

constexpr double kDefaultLimit = 4096.0;  // MB
constexpr double kMegabyte = 1024.0 * 1024.0;

// Bytes, measured with tests/py/test_cost.py's worlds and rounded up; see docs/performance.md.
constexpr double kElement = 2e3;
constexpr double kRay = 300.0;
constexpr double kPixel = 24.0;
constexpr double kHeightSample =
    60.0;  // bytes a sample of a heightmap, with the data of rays and contacts
constexpr double kMeshByte = 6.0;  // a triangle of a binary STL has 50 bytes, of other files more
const std::map<std::string, double>& parts() {
  static const std::map<std::string, double> table = {
      {"link", 8e3},    {"joint", 8e3},  {"collision", 6e3}, {"visual", 4e3},
      {"sensor", 32e3}, {"light", 20e3}, {"plugin", 8e3},    {"actor", 100e3}};
  return table;
}

std::atomic<double>& limit() {
  static std::atomic<double> megabytes = [] {
    const char* given = std::getenv("ANGEN_MEMORY_LIMIT");
    if (given == nullptr) return kDefaultLimit;
    const std::optional<double> value = parse_finite(given);
    if (!value || *value <= 0.0) {
      throw Error("ANGEN_MEMORY_LIMIT is '" + printable(given, 80) +
                  "'; give a number of MB greater than 0, such as 4096");
    }
    return *value;
  }();
  return megabytes;
}

double count_in(const Element& parent, const char* name) {
  const Element* child = parent.child(name);
  const std::optional<double> value = child ? parse_finite(child->text) : std::nullopt;
  return value && *value > 0.0 ? *value : 1.0;
}

double rays_in(const Element& scan) {
  double rays = 1.0;
  for (const char* axis : {"horizontal", "vertical"}) {
    if (const Element* block = scan.child(axis)) rays *= count_in(*block, "samples");
  }
  return rays;
}

std::uint32_t big_endian(const unsigned char* bytes) {
  return static_cast<std::uint32_t>(bytes[0]) << 24U | static_cast<std::uint32_t>(bytes[1]) << 16U |
         static_cast<std::uint32_t>(bytes[2]) << 8U | bytes[3];
}

// By a PNG's header; another file, or a PNG that is too large, is rejected when it is read.
double heights_in(const std::string& heightmap) {
  unsigned char head[24] = {};
  std::ifstream(heightmap, std::ios::binary).read(reinterpret_cast<char*>(head), sizeof head);
  if (std::memcmp(head, "\x89PNG\r\n\x1a\n", 8) != 0) return 0.0;
  const double width = big_endian(head + 16), height = big_endian(head + 20);
  return std::max(width, height) > kMaxPngSide ? 0.0 : width * height;
}

double file_cost(const Element& shape, Session& session) {
  const Element* uri = shape.child("uri");
  if (uri == nullptr) return 0.0;
  const std::optional<std::string> file = find_uri(uri->text, uri->source.file, session);
  // One that it may not name is rejected later; others are shared between their uses.
  if (!file || !session.allowed.holds(*file, uri->source.file)) return 0.0;
  if (!session.counted_files.insert(*file).second) return 0.0;
  std::error_code failed;
  if (!is_plain_file(*file)) return 0.0;
  if (shape.name == "heightmap") return kHeightSample * heights_in(*file);
  const auto size = std::filesystem::file_size(*file, failed);
  return failed ? 0.0 : kMeshByte * static_cast<double>(size);
}

double bytes_of(const Element& element, Session& session) {
  double bytes = kElement;
  const auto part = parts().find(element.name);
  if (part != parts().end()) bytes += part->second;
  if (element.name == "scan") bytes += kRay * rays_in(element);
  if (element.name == "image" && element.child("width") != nullptr) {
    bytes += kPixel * count_in(element, "width") * count_in(element, "height");
  }
  if (element.name == "mesh" || element.name == "heightmap") bytes += file_cost(element, session);
  for (const Element& child : element.children) bytes += bytes_of(child, session);
  return bytes;
}

}  // namespace

double memory_limit() { return limit(); }

void set_memory_limit(double megabytes) {
  if (!std::isfinite(megabytes) || megabytes <= 0.0) {
    throw Error("a memory limit of " + number_text(megabytes) +
                " MB; give a number greater than 0, such as 4096");
  }
  limit() = megabytes;
}

void check_memory(const Element& expanded, Session& session) {
  const double bytes = bytes_of(expanded, session);
  session.bytes += bytes;
  const double most = memory_limit();
  if (session.bytes <= most * kMegabyte) return;
  throw Error(expanded.source,
              tag_of(expanded) + " would take about " + number_text(std::round(bytes / kMegabyte)) +
                  " MB of memory, " + number_text(std::round(session.bytes / kMegabyte)) +
                  " MB with the models before it; the limit is " + number_text(most) +
                  " MB. Make it smaller, or raise ANGEN_MEMORY_LIMIT (MB)");
}

}  // namespace angen::load
