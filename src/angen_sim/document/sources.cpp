#include "document/sources.h"

#include <filesystem>

#include "core/random.h"
#include "document/xml.h"

namespace angen::load {

namespace fs = std::filesystem;

Sources::Seen Sources::inspect(const std::string& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (fs::is_directory(status)) return {Kind::kFolder, 0};
  return {fs::exists(status) ? Kind::kOther : Kind::kNothing, 0};
}

Sources::Kind Sources::note(const std::string& path) {
  const Kind kind = inspect(path).kind;
  seen_.emplace(fs::absolute(path).string(), Seen{kind, 0});
  return kind;
}

bool Sources::exists(const std::string& path) { return note(path) != Kind::kNothing; }

bool Sources::is_folder(const std::string& path) { return note(path) == Kind::kFolder; }

std::string Sources::read(const std::string& path) {
  std::string text = read_file(path);
  Seen& seen = seen_[fs::absolute(path).string()];
  if (seen.kind != Kind::kRead) seen = {Kind::kRead, hash_bytes(text)};
  return text;
}

void Sources::will_be_read(const std::string& path) {
  const auto seen = seen_.find(fs::absolute(path).string());
  if (seen == seen_.end() || seen->second.kind != Kind::kRead) read(path);
}

bool Sources::unchanged() const {
  for (const auto& [path, seen] : seen_) {
    if (seen.kind != Kind::kRead) {
      if (inspect(path).kind != seen.kind) return false;
    } else if (inspect(path).kind != Kind::kOther || hash_bytes(read_file(path)) != seen.hash) {
      return false;
    }
  }
  return true;
}

}  // namespace angen::load
