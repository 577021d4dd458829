#include "record/log.h"

#include <gnu/libc-version.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <utility>

#include "core/files.h"
#include "record/action_line.h"

namespace angen::record {

namespace {

constexpr const char* kMark = "{\"angen_log\"";

// Its first line may be long where it is something else.
void check_begin(std::ifstream& stream, const std::string& path) {
  std::string begin(std::strlen(kMark), ' ');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (stream.gcount() > 0 && begin != kMark) {
    throw Error({path, 1}, "is not a log of angen; it must begin with " + std::string(kMark));
  }
  stream.clear();
  stream.seekg(0);
}

LogHeader header_in(const LineReader& line, const Source& at) {
  const auto format = line.get<std::uint64_t>("angen_log");
  const auto version = line.get<std::string>("version");
  if (format != kLogFormat || version != this_version()) {
    throw Error(at, "was recorded by angen " + version + " (format " + std::to_string(format) +
                        "), this is angen " + this_version() + " (format " +
                        std::to_string(kLogFormat) +
                        "); replay it with the version that recorded it");
  }
  LogHeader header = read_header(line);
  if (header.step <= 0 || header.step > kSecond) line.fail("'step' is not 1 ns to 1 s");
  return header;
}

LogEntry entry_in(const LineReader& line, int number, Nanoseconds step) {
  const auto tick = line.get<std::uint64_t>("tick");
  if (tick > static_cast<std::uint64_t>(std::numeric_limits<Nanoseconds>::max() / step)) {
    line.fail("'tick' exceeds the largest time");
  }
  LogEntry entry{number, static_cast<std::int64_t>(tick), 0, read_content(line)};
  if (entry.is_action()) entry.batch = line.get<std::uint64_t>("batch");
  return entry;
}

}  // namespace

std::string this_version() { return ANGEN_VERSION; }

std::string this_host() {
  std::ifstream stream("/proc/cpuinfo");
  std::string processor = "an unknown processor";
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("model name", 0) != 0 || line.find(": ") == std::string::npos) continue;
    processor = line.substr(line.find(": ") + 2);
    break;
  }
  return "compiler " __VERSION__ ", glibc " + std::string(gnu_get_libc_version()) + ", " +
         processor;
}

Log read_log(const std::string& path) {
  const bool is_file = is_plain_file(path);  // others may not end
  std::ifstream stream(is_file ? path : "", std::ios::binary);
  if (!stream) throw Error({path, 0}, "cannot be read; give a log that record:= wrote");
  check_begin(stream, path);
  Log log{path, {}, {}, ""};
  std::uint64_t sum = 0;
  std::uint64_t byte = 0;
  int number = 0;
  std::uint64_t next_byte = 0;
  for (std::string line; std::getline(stream, line);) {
    byte = std::exchange(next_byte, next_byte + line.size() + 1);
    const Source at{path, ++number};
    if (stream.eof()) {  // without its line break
      if (number == 1) throw Error(at, "ends within its first line; nothing can be replayed");
      log.truncated = Diagnostic{Diagnostic::Severity::kWarning, at,
                                 "the line that begins at byte " + std::to_string(byte) +
                                     " is incomplete; replayed up to there"}
                          .text();
      break;
    }
    const LineReader reader(line, at, byte);
    if (number == 1) log.header = header_in(reader, at);
    reader.check(sum);
    if (number == 1) continue;
    log.entries.push_back(entry_in(reader, number, log.header.step));
    const std::int64_t last = log.entries.size() < 2 ? 0 : log.entries.end()[-2].tick;
    if (log.entries.back().tick - last > (kSecond + log.header.step - 1) / log.header.step) {
      reader.fail("'tick' is more than a second later than in the line before");
    }
  }
  if (number == 0) throw Error({path, 0}, "is empty; nothing can be replayed");
  return log;
}

}  // namespace angen::record
