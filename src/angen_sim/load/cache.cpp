#include "load/cache.h"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cereal/types/map.hpp>
#include <cereal/types/string.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/plugin_path.h"
#include "core/random.h"
#include "core/text.h"
#include "load/bounded_input.h"
#include "load/converter.h"
#include "load/pack.h"
#include "load/xml.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMostBytes = 128U << 20U;  // in the folder

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

// A file and when it was written, empty where there is none.
std::string state_of(const std::string& path) {
  std::error_code failed;
  const auto size = fs::file_size(path, failed);
  if (failed) return "";
  const auto changed = fs::last_write_time(path, failed).time_since_epoch().count();
  return failed ? "" : path + "\n" + std::to_string(size) + "\n" + std::to_string(changed);
}

// Another build of this library may read the same files otherwise.
std::string this_library() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&this_library), &info) == 0) return "";
  return state_of(info.dli_fname);
}

void add_path(std::string& key, const std::string& path) {
  std::error_code failed;
  key += "\n" + path + "\n" + fs::absolute(path, failed).string();
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
    if (total > kMostBytes) fs::remove(file.path);
  }
}

void write_whole(const fs::path& file, const std::string& bytes) {
  static std::atomic<int> count{0};
  const fs::path fresh =
      file.string() + "." + std::to_string(getpid()) + "." + std::to_string(++count);
  std::ofstream stream(fresh, std::ios::binary);
  stream << bytes;
  stream.close();
  if (stream) {
    fs::rename(fresh, file);
  } else {
    fs::remove(fresh);
  }
}

// The bytes of a file that write_summed() left there whole.
std::optional<std::string> read_summed(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string sum(16, ' ');
  std::ostringstream rest;
  if (!stream.read(sum.data(), 16) || !(rest << stream.rdbuf())) return std::nullopt;
  std::string bytes = rest.str();
  return sum == hex(hash_bytes(bytes)) ? std::make_optional(std::move(bytes)) : std::nullopt;
}

void write_summed(const fs::path& file, const std::string& bytes) {
  const fs::path where = file.parent_path();
  fs::create_directories(where);
  write_whole(file, hex(hash_bytes(bytes)) + bytes);
  make_room(where);
}

void mark_used(const fs::path& file) {
  std::error_code failed;
  fs::last_write_time(file, fs::file_time_type::clock::now(), failed);
}

struct MeshFile {
  std::string head;  // what its bytes begin with
  fs::path path;     // empty where there is no cache
};

MeshFile mesh_file(const std::string& key) {
  const fs::path where = folder();
  const std::string library = this_library();
  const std::string program = state_of(mesh_program());
  if (where.empty() || library.empty() || program.empty()) return {};
  const std::string head = library + "\n" + program + "\n" + key + "\n";
  return {head, where / (hex(hash_bytes(head)) + ".mesh")};
}

}  // namespace

Cache::Cache(const std::string& world, const SearchPaths& paths) {
  const fs::path where = folder();
  key_ = this_library();
  if (where.empty() || key_.empty()) return;
  add_path(key_, world);
  for (const std::string& path : paths.models) add_path(key_, path);
  key_ += "\nresources";
  for (const std::string& path : paths.resources) add_path(key_, path);
  key_ += "\npackages";
  for (const std::string& path : paths.packages) add_path(key_, path);
  if (paths.allow_any) key_ += "\nany";
  key_ += "\nstrictness " + std::to_string(static_cast<int>(paths.strictness));
  key_ += "\nplugins";
  for (const fs::path& path : plugin_path()) add_path(key_, path.string());
  key_ += "\nlimit " + number_text(memory_limit());
  file_ = (where / (hex(hash_bytes(key_)) + ".world")).string();
}

std::optional<desc::World> Cache::recall() const {
  if (file_.empty()) return std::nullopt;
  try {
    const std::optional<std::string> whole = read_summed(file_);
    if (!whole) return std::nullopt;
    BoundedInput archive(*whole);
    std::string key;
    Sources sources;
    archive(key);
    if (key != key_) return std::nullopt;
    archive(sources);
    if (!sources.unchanged()) return std::nullopt;
    std::string packed;
    archive(packed);
    desc::World world = unpack(packed);
    mark_used(file_);
    return world;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void Cache::keep(const desc::World& world, const Sources& sources) const {
  if (file_.empty()) return;
  try {
    std::ostringstream rest(std::ios::binary);
    cereal::BinaryOutputArchive archive(rest);
    archive(key_, sources, pack(world));
    write_summed(file_, rest.str());
  } catch (const std::exception&) {
    return;  // it will be read again
  }
}

std::optional<std::string> recall_mesh(const std::string& key) {
  try {
    const MeshFile file = mesh_file(key);
    if (file.path.empty()) return std::nullopt;
    const std::optional<std::string> bytes = read_summed(file.path);
    if (!bytes || bytes->compare(0, file.head.size(), file.head) != 0) return std::nullopt;
    mark_used(file.path);
    return bytes->substr(file.head.size());
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void keep_mesh(const std::string& key, const std::string& answer) {
  try {
    const MeshFile file = mesh_file(key);
    if (!file.path.empty()) write_summed(file.path, file.head + answer);
  } catch (const std::exception&) {
    return;  // it will be converted again
  }
}

}  // namespace angen::load
