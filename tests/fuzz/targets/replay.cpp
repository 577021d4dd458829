#include <algorithm>

#include "core/random.h"
#include "fuzz/targets.h"
#include "record/fingerprint.h"
#include "record/log.h"

namespace angen::fuzz {
namespace {

// VERSION is ours: a log of another is not read.
std::string with_version(std::string log) {
  const std::string word = "VERSION";
  const std::size_t at = log.find(word);
  return at == std::string::npos ? log : log.replace(at, word.size(), record::this_version());
}

// Nor is a line whose checksum is wrong.
std::string with_checksums(const std::string& input) {
  const std::string key = ",\"sum\":\"";
  std::string out;
  std::uint64_t sum = 0;
  for (std::size_t start = 0; start < input.size();) {
    const std::size_t end = std::min(input.find('\n', start), input.size());
    std::string line = input.substr(start, end - start);
    line.resize(std::min({line.rfind(key), line.rfind('}'), line.size()}));
    sum = hash_bytes(line, sum);
    out += line + key + record::fingerprint_text(sum) + "\"}\n";
    start = end + 1;
  }
  return out;
}

}  // namespace

void replay(const std::string& input) {
  static const MemoryFile file(".log");
  file.write(with_checksums(with_version(input)));
  answered([&] { record::read_log(file.path()); });
}

}  // namespace angen::fuzz
