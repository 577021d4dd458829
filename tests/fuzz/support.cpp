#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "fuzz/targets.h"

namespace angen::fuzz {

namespace fs = std::filesystem;

void require(bool kept, const char* promise) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

// /dev/shm, since millions of inputs are written.
MemoryFile::MemoryFile(const std::string& ending) {
  const fs::path memory = "/dev/shm";
  std::error_code failed;
  const fs::path where = fs::is_directory(memory, failed) ? memory : fs::temp_directory_path();
  folder_ = (where / "angen_fuzz_XXXXXX").string();
  if (mkdtemp(folder_.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = folder_ + "/input" + ending;
}

MemoryFile::~MemoryFile() {
  std::error_code failed;
  fs::remove_all(folder_, failed);
}

void MemoryFile::write(const std::string& bytes) const {
  std::ofstream stream(path_, std::ios::binary | std::ios::trunc);
  stream << bytes;
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + path_);
}

Split split(const std::string& input) {
  if (input.empty()) return {};
  return {static_cast<unsigned char>(input.front()), input.substr(1)};
}

}  // namespace angen::fuzz
