#include "sdf/cache.h"

#include <cereal/types/map.hpp>
#include <cereal/types/string.hpp>
#include <filesystem>
#include <sstream>

#include "assets/bounded_input.h"
#include "assets/cache_file.h"
#include "assets/mesh.h"
#include "core/plugin_path.h"
#include "core/text.h"
#include "document/xml.h"
#include "import/upgrade.h"
#include "sdf/pack.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

template <class Function>
std::string library_of(Function* function) {
  return "\n" + library_state(reinterpret_cast<const void*>(function));
}

std::string libraries() {
  return library_of(&pack) + library_of(&upgrade) + library_of(&read_mesh) + library_of(&parse_xml);
}

void add_path(std::string& key, const std::string& path) {
  std::error_code failed;
  key += "\n" + path + "\n" + fs::absolute(path, failed).string();
}

}  // namespace

Cache::Cache(const std::string& world, const SearchPaths& paths) {
  key_ = libraries();
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
  file_ = cache_file(key_, ".world");
}

std::optional<desc::World> Cache::recall() const {
  if (file_.empty()) return std::nullopt;
  try {
    const std::optional<std::string> whole = read_cache_file(file_);
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
    return unpack(packed);
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
    write_cache_file(file_, rest.str());
  } catch (const std::exception&) {
    return;  // it will be read again
  }
}

}  // namespace angen::load
