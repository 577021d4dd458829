#include "assets/cache_file.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/plain_file.h"
#include "core/private_file.h"
#include "core/random.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMaxBytes = 128U << 20U;  // in the folder

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// By the XDG base directory specification, which has relative paths ignored.
fs::path folder() {
  if (!variable("ANGEN_NO_CACHE").empty()) return {};
  const fs::path given = variable("XDG_CACHE_HOME");
  if (given.is_absolute()) return given / "angen";
  const fs::path home = variable("HOME");
  return home.is_absolute() ? home / ".cache" / "angen" : fs::path{};
}

std::string hex(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016lx", static_cast<unsigned long>(number));
  return text;
}

// Removes the least recently used files until the rest fit.
void make_room(const fs::path& folder) {
  struct File {
    fs::file_time_type used;
    fs::path path;
    std::uintmax_t size;
    bool operator<(const File& o) const { return used > o.used; }
  };
  std::vector<File> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    files.push_back({entry.last_write_time(), entry.path(), entry.file_size()});
  }
  std::sort(files.begin(), files.end());
  std::uintmax_t total = 0;
  for (const File& file : files) {
    total += file.size;
    if (total > kMaxBytes) fs::remove(file.path);
  }
}

}  // namespace

std::string cache_file(const std::string& key, const std::string& extension) {
  const fs::path where = folder();
  return where.empty() ? "" : (where / (hex(hash_bytes(key)) + extension)).string();
}

std::optional<std::string> read_cache_file(const std::string& file) {
  if (!is_plain_file(file)) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  std::string sum(16, ' ');
  std::ostringstream rest;
  if (!stream.read(sum.data(), 16) || !(rest << stream.rdbuf())) return std::nullopt;
  std::string bytes = rest.str();
  if (sum != hex(hash_bytes(bytes))) return std::nullopt;
  std::error_code failed;
  fs::last_write_time(file, fs::file_time_type::clock::now(), failed);
  return bytes;
}

void write_cache_file(const std::string& file, const std::string& bytes) {
  const fs::path where = fs::path(file).parent_path();
  make_private_folder(where.string());
  write_private_file(file, hex(hash_bytes(bytes)) + bytes);
  make_room(where);
}

std::string file_state(const std::string& path) {
  std::error_code failed;
  const auto size = fs::file_size(path, failed);
  if (failed) return "";
  const auto changed = fs::last_write_time(path, failed).time_since_epoch().count();
  return failed ? "" : path + "\n" + std::to_string(size) + "\n" + std::to_string(changed);
}

std::string library_state(const void* symbol) {
  Dl_info info{};
  return dladdr(symbol, &info) == 0 ? "" : file_state(info.dli_fname);
}

}  // namespace angen::load
